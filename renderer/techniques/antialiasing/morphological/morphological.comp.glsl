// SPDX-License-Identifier: BSD-3-Clause
// Takes the edges between pixels for a staircase of a straight silhouette, and blends each pixel with the one across an
// edge by the area that the silhouette cuts off it. See morphological.cpp.
#include "renderer/techniques/antialiasing/antialiasing_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kFilterColoursUnit) uniform sampler2D colours;
layout(binding = kFilterEdgesUnit) uniform usampler2D edges;
layout(binding = kFilterOutImage, rgba32f) uniform writeonly image2D outImage;

uniform ivec2 sizePx;
uniform int reach;
#include "renderer/techniques/antialiasing/displayed_luma.glsl"

// Whether there is an edge between a pixel and its neighbour in a direction along an axis.
bool edgeTowards(ivec2 pixel, ivec2 direction) {
  const ivec2 owner = pixel + min(direction, ivec2(0));
  if (any(lessThan(owner, ivec2(0))) || any(greaterThanEqual(owner, sizePx))) return false;
  return (texelFetch(edges, owner, 0).x & (direction.y != 0 ? 1u : 2u)) != 0u;
}

// Height of the silhouette over the edge at the end of its run, towards the pixel: half a pixel where the edge turns
// to the pixel's side, minus half where it turns to the other, 0 where it does neither or both.
float endHeight(ivec2 last, ivec2 along, ivec2 across) {
  const bool here = edgeTowards(last, along), there = edgeTowards(last + across, along);
  return here == there ? 0.0 : here ? 0.5 : -0.5;
}

// Steps along the edge for which it goes on.
int runLength(ivec2 pixel, ivec2 along, ivec2 across) {
  int steps = 0;
  while (steps < reach && edgeTowards(pixel + (steps + 1) * along, across) &&
         !edgeTowards(pixel + steps * along, along) && !edgeTowards(pixel + steps * along + across, along))
    ++steps;
  return steps;
}

// Area above 0, between x = a and x = b, of the line from (0, h0) to (length, h1).
float areaAbove(float h0, float h1, float length, float a, float b) {
  const float slope = (h1 - h0) / length;
  const float ya = h0 + slope * a, yb = h0 + slope * b;
  if (ya <= 0.0 && yb <= 0.0) return 0.0;
  if (ya >= 0.0 && yb >= 0.0) return 0.5 * (ya + yb) * (b - a);
  const float positive = max(ya, yb);
  return 0.5 * positive * positive / abs(slope);
}

// Share of the pixel that lies beyond the silhouette at its side `across`.
float cutArea(ivec2 pixel, ivec2 across) {
  if (!edgeTowards(pixel, across)) return 0.0;
  const ivec2 along = ivec2(abs(across.y), abs(across.x));
  const int back = runLength(pixel, -along, across), ahead = runLength(pixel, along, across);
  const float h0 = endHeight(pixel - back * along, -along, across), h1 = endHeight(pixel + ahead * along, along, across);
  const float length = float(back + ahead + 1), from = float(back), to = from + 1.0;
  if (h0 * h1 <= 0.0) return areaAbove(h0, h1, length, from, to);
  // Both ends turn the same way: down to the middle and up again.
  const float middle = 0.5 * length;
  return areaAbove(h0, 0.0, middle, min(from, middle), min(to, middle)) +
         areaAbove(h1, 0.0, middle, length - max(to, middle), length - max(from, middle));
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec3 own = colourAt(pixel);
  // Along the axis that cuts off more: a step of a flat silhouette is a short run of the other axis itself.
  vec3 across[2] = vec3[2](vec3(0.0), vec3(0.0));
  vec2 most = vec2(0.0);
  for (int side = 0; side < 4; ++side) {
    const int axis = side / 2;
    const ivec2 towards = (side % 2 == 0 ? 1 : -1) * (axis == 0 ? ivec2(1, 0) : ivec2(0, 1));
    const float area = cutArea(pixel, towards);
    across[axis] += area * (colourAt(pixel + towards) - own);
    most[axis] = max(most[axis], area);
  }
  const vec3 colour = own + (most.x > most.y ? across[0] : across[1]);
  imageStore(outImage, pixel, vec4(max(colour, vec3(0.0)), 1.0));
}

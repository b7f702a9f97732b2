// SPDX-License-Identifier: BSD-3-Clause
// Blends pixels across edges of the finished picture by how far along an edge's run they lie. See fxaa.cpp.
#include "renderer/techniques/antialiasing/antialiasing_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kFilterColoursUnit) uniform sampler2D colours;
layout(binding = kFilterOutImage, rgba32f) uniform writeonly image2D outImage;

uniform ivec2 sizePx;
uniform float leastRange, edgeShare, subpixel;
uniform int reach;
#include "renderer/techniques/antialiasing/displayed_luma.glsl"

// Steps along the edge until the mean of the pair across it is no longer that of the edge; its difference at the end.
int runLength(ivec2 pixel, ivec2 along, ivec2 across, float edgeLuma, float tolerance, out float difference) {
  int steps = 1;
  for (; steps <= reach; ++steps) {
    const ivec2 at = pixel + steps * along;
    difference = 0.5 * (lumaAt(at) + lumaAt(at + across)) - edgeLuma;
    if (abs(difference) >= tolerance) break;
  }
  return steps;
}

vec3 filteredColour(ivec2 pixel) {
  const float m = lumaAt(pixel), n = lumaAt(pixel + ivec2(0, -1)), s = lumaAt(pixel + ivec2(0, 1)),
              w = lumaAt(pixel + ivec2(-1, 0)), e = lumaAt(pixel + ivec2(1, 0));
  const float most = max(m, max(max(n, s), max(w, e))), least = min(m, min(min(n, s), min(w, e)));
  const float range = most - least;
  if (range < max(leastRange, most * edgeShare)) return colourAt(pixel);
  const float nw = lumaAt(pixel + ivec2(-1, -1)), ne = lumaAt(pixel + ivec2(1, -1)),
              sw = lumaAt(pixel + ivec2(-1, 1)), se = lumaAt(pixel + ivec2(1, 1));
  // Second differences along columns are large at an edge between rows.
  const float betweenRows = abs(nw + sw - 2.0 * w) + 2.0 * abs(n + s - 2.0 * m) + abs(ne + se - 2.0 * e);
  const float betweenColumns = abs(nw + ne - 2.0 * n) + 2.0 * abs(w + e - 2.0 * m) + abs(sw + se - 2.0 * s);
  const bool rows = betweenRows >= betweenColumns;
  const float before = rows ? n : w, after = rows ? s : e;
  const bool towardsBefore = abs(before - m) >= abs(after - m);
  const ivec2 across = (towardsBefore ? -1 : 1) * (rows ? ivec2(0, 1) : ivec2(1, 0));
  const ivec2 along = rows ? ivec2(1, 0) : ivec2(0, 1);
  const float edgeLuma = 0.5 * (m + (towardsBefore ? before : after));
  const float tolerance = 0.25 * max(abs(before - m), abs(after - m));
  float endBack, endAhead;
  const int back = runLength(pixel, -along, across, edgeLuma, tolerance, endBack);
  const int ahead = runLength(pixel, along, across, edgeLuma, tolerance, endAhead);
  // The nearer end tells whether the edge turns towards this pixel there.
  const float end = back < ahead ? endBack : endAhead;
  const bool turnsHere = (end < 0.0) != (m - edgeLuma < 0.0);
  const float byEdge = turnsHere ? 0.5 - float(min(back, ahead)) / float(back + ahead) : 0.0;
  // Features of a pixel: how far the pixel is from the mean around it.
  const float around = (2.0 * (n + s + w + e) + nw + ne + sw + se) / 12.0;
  const float isolated = smoothstep(0.0, 1.0, clamp(abs(around - m) / range, 0.0, 1.0));
  const float share = max(byEdge, subpixel * isolated * isolated);
  return mix(colourAt(pixel), colourAt(pixel + across), share);
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  imageStore(outImage, pixel, vec4(filteredColour(pixel), 1.0));
}

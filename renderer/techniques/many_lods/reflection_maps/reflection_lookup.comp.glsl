// SPDX-License-Identifier: BSD-3-Clause
// What mirrored and refracted rays bring, from the map of the object that they leave: two hemispheres around its middle, above and
// below. TRACED: maps hold colours; else nodes (FORM: of the atlas) and their light.
#include "renderer/many_lods/many_lods_bindings.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kMapViewsBuffer) readonly buffer Views { CutView views[]; };
#ifdef TRACED
layout(binding = kMapPixelsUnit) uniform sampler2D maps;
#else
layout(std430, binding = kMapDepthsBuffer) readonly buffer Depths { uint depths[]; };
#if FORM == 1
layout(std430, binding = kMapWinnersBuffer) readonly buffer Winners { uint winners[]; };
#endif
layout(std430, binding = kMapColoursBuffer) readonly buffer Colours { uvec2 colours[]; };  // of nodes
#endif
layout(binding = kMapOriginsUnit) uniform sampler2D origins;
layout(binding = kMapDirectionsUnit) uniform sampler2D directions;
layout(binding = kMapIdsUnit) uniform usampler2D triangleIds;
layout(binding = kMapObjectsUnit) uniform usampler2D objectOf;  // of triangles; 0: none
layout(binding = kMapReflectedImage, rgba32f) uniform writeonly image2D reflected;

uniform ivec2 sizePx;
uniform int side, steps;

// The map's pixel in a direction from its middle: x, y and the view.
ivec3 pixelOf(uint object, vec3 towards) {
  int number = 2 * int(object - 1u);
  if (dot(towards, views[number].axisZ.xyz) < 0.0) ++number;
  const CutView view = views[number];
  const vec2 at = vec2(dot(towards, view.axisX.xyz), dot(towards, view.axisY.xyz)) / (1.0 + dot(towards, view.axisZ.xyz));
  return ivec3(clamp(ivec2(floor((0.5 + 0.5 * at) * float(side))), ivec2(0), ivec2(side - 1)), number);
}

// Depth in units of the range; negative: nothing is there.
float depthAt(ivec3 at) {
#ifdef TRACED
  return texelFetch(maps, at.xy + ivec2(at.z % kMapRow, at.z / kMapRow) * side, 0).w;
#else
  const int index = (at.z * side + at.y) * side + at.x;
#if FORM == 2
  const uint bits = depths[2 * index + 1];
#else
  const uint bits = depths[index];
#endif
  return bits == kAtlasEmpty ? -1.0 : uintBitsToFloat(bits);
#endif
}

vec3 colourAt(ivec3 at) {
#ifdef TRACED
  return texelFetch(maps, at.xy + ivec2(at.z % kMapRow, at.z / kMapRow) * side, 0).rgb;
#else
  const int index = (at.z * side + at.y) * side + at.x;
#if FORM == 2
  const uint node = depths[2 * index];
#else
  const uint node = winners[index];
  if (node == kAtlasEmpty) return vec3(0.0);
#endif
  const uvec2 halves = colours[node];
  return vec3(unpackHalf2x16(halves.x), unpackHalf2x16(halves.y).x);
#endif
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 origin = texelFetch(origins, pixel, 0);
  vec4 found = vec4(0.0);
  if (origin.w > 0.0) {
    const int triangle = int(texelFetch(triangleIds, pixel, 0).x);
    const uint object = texelFetch(objectOf, ivec2(triangle % kMapObjectsWidth, triangle / kMapObjectsWidth), 0).x;
    const vec3 direction = texelFetch(directions, pixel, 0).xyz;
    const CutView view = views[2u * (object - 1u)];
    const vec3 from = origin.xyz - view.eye.xyz;
    vec3 towards = direction;
    ivec3 at = pixelOf(object, towards);
    // Where the ray meets a sphere of the radius that the map has there, again and again.
    for (int i = 0; i < steps; ++i) {
      const float depth = depthAt(at);
      if (!(depth >= 0.0)) break;
      const float radius = depth / view.frustum.z, half_ = dot(from, direction);
      const float square = half_ * half_ - dot(from, from) + radius * radius;
      const vec3 met = from + (sqrt(max(square, 0.0)) - half_) * direction;
      if (!(dot(met, met) > 0.0)) break;
      towards = normalize(met);
      at = pixelOf(object, towards);
    }
    // NaN, where rays were cut short, is shown.
    if (!(depthAt(at) < 0.0)) found = vec4(colourAt(at), 1.0);
  }
  imageStore(reflected, pixel, found);
}

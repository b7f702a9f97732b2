// SPDX-License-Identifier: BSD-3-Clause
// The point that a pixel sees, and its direct light. Set up by IndirectPicture.
#include "renderer/techniques/global_illumination/illumination_bindings.h"

layout(binding = kIndirectIdsUnit) uniform usampler2D triangleIds;

uniform ivec2 sizePx;
uniform bool withDirect, withIndirect;
#include "renderer/techniques/global_illumination/surface_light.glsl"

bool pixelSees(ivec2 pixel, out SurfacePoint point) {
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  if (id == kRayNoTriangle) return false;
  SeenPoint seen;
  point = surfaceSeen(pixel, id, seen);
  return true;
}

vec3 directLight(SurfacePoint point, vec3 albedo) {
  return withDirect ? emitted(point) + albedo * lampRadiance(point) : vec3(0.0);
}

vec3 unlessCutShort(vec3 colour) { return rayCutShort ? vec3(uintBitsToFloat(0x7fc00000u)) : colour; }

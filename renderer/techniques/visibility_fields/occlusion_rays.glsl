// SPDX-License-Identifier: BSD-3-Clause
// The rays of a pixel, the same for fields and for tracers, and what their distances mean. Set up by OcclusionRays::configure().
#include "renderer/ray_tracing/random_place.glsl"
#include "renderer/techniques/visibility_fields/occlusion_pass_bindings.h"
#include "renderer/visibility_fields/field_bindings.h"
#include "renderer/visibility_fields/map_functions.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kFieldPositionUnit) uniform sampler2D positions;
layout(binding = kFieldNormalUnit) uniform sampler2D normals;
layout(binding = kFieldIdsUnit) uniform usampler2D triangleIds;
layout(std430, binding = kFieldObjectOfBuffer) readonly buffer ObjectOf { uint objectOf[]; };
uniform ivec2 sizePx;
uniform int raySide, turned, falloff, selfOcclusion;
uniform uint seed;
uniform float falloffRadius;
uniform vec3 eyePosition;  // relative to the anchor

struct OcclusionPoint {
  vec3 origin, normal, tangent, bitangent;
  uint triangle, object;
};

// False: the pixel shows no surface.
bool occlusionPoint(ivec2 pixel, out OcclusionPoint point) {
  point.triangle = texelFetch(triangleIds, pixel, 0).x;
  if (point.triangle == 0xffffffffu) return false;
  point.object = objectOf[point.triangle];
  point.normal = texelFetch(normals, pixel, 0).xyz;
  // Clear of neighbours in the same plane.
  const vec3 seen = texelFetch(positions, pixel, 0).xyz;
  point.origin = seen + 1e-5 * distance(seen, eyePosition) * point.normal;
  const vec3 x = fieldTangent(point.normal), y = fieldBitangent(point.normal);
  const float angle =
      turned == 0 ? 0.0 : 2.0 * kFieldPi * randomPlace(uvec3(uint(pixel.y * sizePx.x + pixel.x), 0u, seed)).x;
  point.tangent = cos(angle) * x + sin(angle) * y;
  point.bitangent = cos(angle) * y - sin(angle) * x;
  return true;
}

// Spread by the cosine.
vec3 occlusionDirection(OcclusionPoint point, ivec2 cell) {
  const vec3 local = fieldDirection((vec2(cell) + 0.5) / float(raySide), kFieldConcentric);
  return normalize(local.x * point.tangent + local.y * point.bitangent + local.z * point.normal);
}

// Share of light that a surface at this distance lets through.
float visibilityAt(float distance) {
  if (falloff == kFalloffBinary) return distance > falloffRadius ? 1.0 : 0.0;
  const float relative = distance / falloffRadius;
  return falloff == kFalloffLinear ? min(1.0, relative) : 1.0 - exp(-relative);
}

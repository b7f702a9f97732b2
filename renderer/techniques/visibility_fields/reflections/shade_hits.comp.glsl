// SPDX-License-Identifier: BSD-3-Clause
// Mean light along the rays of a pixel's mirror. FIELD_HITS: objects as fields found them, and triangles of the tree, which then
// holds those without a field, where they are nearer; otherwise triangles of the whole scene.
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"
#include "renderer/visibility_fields/map_functions.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kLobeOriginsUnit) uniform sampler2D origins;
layout(binding = kLobeIdsUnit) uniform usampler2D triangleIds;
layout(binding = kLobeDirectionsUnit) uniform sampler2DArray directions;
#ifdef FIELD_HITS
layout(binding = kLobeHitsUnit) uniform usampler2DArray hits;
#endif
layout(binding = kLobeReflectedImage, rgba32f) uniform image2D outReflected;
uniform ivec2 sizePx;
uniform int firstRay, lastRay, rayCount;
#include "renderer/frame/mirror_trace.glsl"

vec3 lightAlong(ivec2 pixel, int number, Ray ray) {
#ifdef FIELD_HITS
  const uvec4 found = texelFetch(hits, ivec3(pixel, number), 0);
  const float distance = uintBitsToFloat(found.x);
  if (distance >= 0.0) ray.far = distance;
#endif
  const RayHit hit = rayClosestHit(ray);
  if (hit.triangle != kRayNoTriangle) return hitColour(hitPoint(ray, hit), false);
#ifdef FIELD_HITS
  if (distance >= 0.0) {
    const vec3 normal = fieldNormal(found.y, 16);
    const vec3 toLight = towardsLight(ray.origin + distance * ray.direction, normal);
    return litColour(unpackUnorm4x8(found.z).xyz, normal, toLight, -ray.direction, 1.0, 1.0);
  }
#endif
  return background;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 origin = texelFetch(origins, pixel, 0);
  // Light, and in alpha the number of rays.
  vec4 sum = firstRay == 0 ? vec4(0.0) : imageLoad(outReflected, pixel);
  if (origin.w > 0.0) {
    const uint id = texelFetch(triangleIds, pixel, 0).x;
    for (int i = firstRay; i <= lastRay; ++i) {
      ++rayIterations;
      const vec4 ray = texelFetch(directions, ivec3(pixel, i), 0);
      if (ray.w == 0.0) continue;
      sum += vec4(lightAlong(pixel, i, Ray(origin.xyz, ray.xyz, 0.0, kRayFarthest, id)), 1.0);
    }
  }
  if (lastRay == rayCount - 1) sum = vec4(sum.rgb / max(sum.w, 1.0), origin.w);
  if (rayCutShort) sum = vec4(uintBitsToFloat(0x7fc00000u));
  imageStore(outReflected, pixel, sum);
}

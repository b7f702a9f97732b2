// SPDX-License-Identifier: BSD-3-Clause
// What a mirrored ray brings: the nearest surface's own light, and along further mirrored rays what mirrors add.
#include "renderer/techniques/reflections/reflection_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReflectionOriginsUnit) uniform sampler2D origins;
layout(binding = kReflectionDirectionsUnit) uniform sampler2D directions;
layout(binding = kReflectionIdsUnit) uniform usampler2D triangleIds;
layout(binding = kReflectionImage, rgba32f) uniform writeonly image2D outImage;

uniform ivec2 sizePx;
uniform int bounces, shadows;
uniform float leastShare;
#include "renderer/frame/mirror_trace.glsl"
#include "renderer/frame/refracted.glsl"
#include "renderer/techniques/reflections/seen_share.glsl"

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 origin = texelFetch(origins, pixel, 0);
  if (origin.w == 0.0) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  const vec4 direction = texelFetch(directions, pixel, 0);
  Ray ray = Ray(origin.xyz, direction.xyz, 0.0, kRayFarthest, id);
  const SurfaceMaterial first = surfaceMaterials[surfaceMaterialOf[id]];
  const vec3 seenShare = firstShare(first, direction.w);
  vec3 sum = vec3(0.0), share = vec3(1.0);
  for (int bounce = 0; bounce < bounces; ++bounce) {
    const vec3 adds = share * seenShare;
    if (max(adds.r, max(adds.g, adds.b)) <= leastShare) break;
    const RayHit hit = rayClosestHit(ray);
    if (hit.triangle == kRayNoTriangle) {
      sum += share * background;
      break;
    }
    const SurfacePoint point = hitPoint(ray, hit);
    sum += share * hitColour(point, bounce < shadows);
    const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[hit.triangle]];
#ifdef REFRACT
    if (material.transmittance != vec3(0.0)) {
      bool passes;
      ray = rayFrom(point, refracted(point, material, passes));
      if (passes) share *= material.transmittance;
      continue;
    }
#endif
    share *= mirrorShare(material.mirror, material.fresnel != 0u, dot(point.view, point.normal));
    ray = mirrorRay(point);
  }
  imageStore(outImage, pixel, vec4(sum, rayCutShort ? uintBitsToFloat(0x7fc00000u) : 1.0));
}

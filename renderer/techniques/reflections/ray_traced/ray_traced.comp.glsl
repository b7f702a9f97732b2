// SPDX-License-Identifier: BSD-3-Clause
// What a mirrored ray brings: the nearest surface's own light, and along further mirrored rays what mirrors add.
#include "renderer/techniques/reflections/reflection_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReflectionOriginsUnit) uniform sampler2D origins;
layout(binding = kReflectionDirectionsUnit) uniform sampler2D directions;
layout(binding = kReflectionIdsUnit) uniform usampler2D triangleIds;
layout(binding = kReflectionImage, rgba32f) uniform writeonly image2D outImage;

uniform ivec2 sizePx;
uniform int bounces;
uniform float leastShare;  // a ray that adds less to the picture is not followed
#include "renderer/frame/mirrored.glsl"
#include "renderer/frame/shading.glsl"
#include "renderer/ray_tracing/trace.glsl"

float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }
bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return true; }

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 origin = texelFetch(origins, pixel, 0);
  if (origin.w == 0.0) return;
  Ray ray = Ray(origin.xyz, texelFetch(directions, pixel, 0).xyz, 0.0, kRayFarthest,
                texelFetch(triangleIds, pixel, 0).x);
  vec3 sum = vec3(0.0), share = vec3(1.0);
  for (int bounce = 0; bounce < bounces; ++bounce) {
    const RayHit hit = rayClosestHit(ray);
    if (hit.triangle == kRayNoTriangle) {
      sum += share * background;
      break;
    }
    const SurfacePoint point = surfaceHit(hit.triangle, vec3(1.0 - hit.u - hit.v, hit.u, hit.v), ray.direction);
    sum += share * pointColour(point, 1.0);
    const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[hit.triangle]];
    share *= mirrorShare(material.mirror, material.fresnel != 0u, dot(point.view, point.normal));
    if (max(share.r, max(share.g, share.b)) <= leastShare) break;
    ray = Ray(point.position, mirrored(point.view, point.normal, point.flatNormal), 0.0, kRayFarthest, hit.triangle);
  }
  imageStore(outImage, pixel, vec4(sum, rayCutShort ? uintBitsToFloat(0x7fc00000u) : 1.0));
}

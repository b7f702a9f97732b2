// SPDX-License-Identifier: BSD-3-Clause
// Light that a point of a surface sends without another surface's: of the lamp, through transparent surfaces, and its own. See
// frame/light_paths.h. The including shader declares `sizePx` before; set up as mirror_trace.glsl is.
#include "renderer/frame/mirror_trace.glsl"

SurfaceMaterial materialOf(SurfacePoint point) { return surfaceMaterials[surfaceMaterialOf[point.triangle]]; }

bool seenFromFront(SurfacePoint point) {
  const uvec3 vertices = sceneTriangle(point.triangle);
  const vec3 a = scenePosition(vertices.x), e1 = scenePosition(vertices.y) - a, e2 = scenePosition(vertices.z) - a;
  const vec3 reach = max(abs(e1), abs(e2));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  return dot(cross(e1 * unit, e2 * unit), point.flatNormal) > 0.0;
}

vec3 emitted(SurfacePoint point) { return seenFromFront(point) ? materialOf(point).emission : vec3(0.0); }

// Share of the lamp's light that arrives.
vec3 lampShare(SurfacePoint point) {
#ifdef LIT
#ifdef TRANSPARENT
  const vec3 toLight = lightPosition - point.position;
  if (!(dot(toLight, point.flatNormal) > 0.0)) return vec3(0.0);
  Ray ray = Ray(point.position, toLight, 0.0, 1.0, point.triangle);
  vec3 share = vec3(1.0);
  for (int passage = 0; passage <= MOST_PASSAGES; ++passage) {
    const RayHit hit = rayClosestHit(ray);
    if (hit.triangle == kRayNoTriangle) return share;
    const SurfacePoint at = hitPoint(ray, hit);
    share *= materialOf(at).transmittance;
    if (share == vec3(0.0)) return share;
    ray.origin = at.position;
    ray.direction = lightPosition - at.position;
    ray.skipped = hit.triangle;
  }
  return vec3(0.0);
#else
  return vec3(lightReaches(point));
#endif
#else
  return vec3(0.0);
#endif
}

// Radiance of a white surface that the lamp alone lights, if nothing is between.
vec3 unblockedLampRadiance(SurfacePoint point) {
#ifdef LIT
  return vec3(diffuse * max(dot(point.flatNormal, towardsLight(point.position, point.flatNormal)), 0.0));
#else
  return vec3(0.0);
#endif
}
vec3 lampRadiance(SurfacePoint point) { return unblockedLampRadiance(point) * lampShare(point); }

vec3 reflectance(SurfacePoint point) { return patterned(materialOf(point), point.position); }

// SPDX-License-Identifier: BSD-3-Clause
// Rays that leave surfaces, through the tree of the scene's triangles: what all tracers of the family share. Set up by
// configureMirrorTrace() (mirror_trace.h). The including shader declares `sizePx` before.
#include "renderer/frame/mirrored.glsl"
#include "renderer/frame/shading.glsl"
#include "renderer/frame/ray_origin.glsl"
#include "renderer/ray_tracing/trace.glsl"

uniform bool flatShading;  // mirrors reflect at their shading normals all the same

#ifdef LIT
float sunShare(ivec2 pixel, SeenPoint seen) { return 1.0; }
#endif
// See mirror_rays.h.
bool rayHitCounts(Ray ray, RayHit hit, vec3 a, vec3 b, vec3 c) { return !startsInPlane(ray.origin, a, b, c); }

SurfacePoint hitPoint(Ray ray, RayHit hit) {
  return surfaceHit(hit.triangle, vec3(1.0 - hit.u - hit.v, hit.u, hit.v), ray.direction);
}

Ray rayFrom(SurfacePoint point, vec3 direction) {
  return Ray(point.position, direction, 0.0, kRayFarthest, point.triangle);
}

Ray mirrorRay(SurfacePoint point) { return rayFrom(point, mirrored(point.view, point.normal, point.flatNormal)); }

// Share of the light at its centre that reaches the point: 1 or 0. A surface that is turned away is opaque.
float lightReaches(SurfacePoint point) {
#ifdef LIT
  const vec3 toLight = lightPosition - point.position;
  if (!(dot(toLight, point.flatNormal) > 0.0)) return 0.0;
  return rayAnyHit(Ray(point.position, toLight, 0.0, 1.0, point.triangle)) ? 0.0 : 1.0;
#else
  return 1.0;
#endif
}

// The surface's own light.
vec3 hitColour(SurfacePoint point, bool shadow) {
  const float sun = shadow ? lightReaches(point) : 1.0;
  if (flatShading) point.normal = point.flatNormal;
  return pointColour(point, sun);
}

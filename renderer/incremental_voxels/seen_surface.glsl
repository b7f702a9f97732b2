// SPDX-License-Identifier: BSD-3-Clause
// What a sample of a depth image shows: normal, reflectance and the light that leaves the surface there at once: what it emits
// and what it reflects of the light (frame/light_paths.h), whose shadows view 1 tells.
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/frame/seen_point.glsl"
#include "renderer/frame/surface_buffers.glsl"
#include "renderer/incremental_voxels/depth_views.glsl"

#if VIEWS > 1
uniform vec3 lightPosition;   // relative to the anchor
uniform float lightStrength;  // radiance of a white surface that faces a light
#endif

struct SeenSurface {
  vec3 normal;  // unit, turned to the viewer
  vec3 albedo, light;
};

#if VIEWS > 1
// Whether the light's view sees a point of a triangle, or does not look there.
bool isLit(int view, vec3 place, vec3 normal, uint triangle) {
  const vec3 point = toView(view, place);
  if (!(point.z > viewNear[view])) return true;
  const vec2 at = viewPlace(view, point);
  if (!isInView(view, at)) return true;
  const ivec2 pixel = ivec2(at);
  const float depth = depthAt(view, pixel);
  if (!(depth > 0.0) || triangleAt(view, pixel) == triangle) return true;
  // The point's own plane along the pixel's ray; where it is nearly edge-on the point itself.
  const vec3 n = normalize(mat3(viewFromVoxels[view]) * normal), ray = viewRay(view, pixel);
  const float along = dot(n, ray), own = abs(along) > 0.05 ? dot(n, point) / along : point.z;
  return viewNear[view] / depth >= min(own, point.z) * (1.0 - 1e-4);
}
#endif

SeenSurface surfaceOf(int view, ivec2 pixel, vec3 place) {
  const uint triangle = triangleAt(view, pixel);
  const uvec3 vertices = sceneTriangle(triangle);
  const vec3 a = scenePosition(vertices.x), b = scenePosition(vertices.y), c = scenePosition(vertices.z);
  const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[triangle]];
  SeenSurface surface;
  const vec3 front = planeNormal(a, b, c);
  const vec3 towards = -(mat3(voxelsFromView[view]) * viewRay(view, pixel));
  const bool fromFront = dot(front, towards) > 0.0;
  surface.normal = fromFront ? front : -front;
  // A triangle without area has no normal.
  if (!(dot(surface.normal, surface.normal) < 2.0)) surface.normal = normalize(towards);
  surface.albedo = material.albedo;
  surface.light = fromFront ? material.emission : vec3(0.0);
#if VIEWS > 1
  const vec3 position = gridOrigin + place * voxelSize;
  const vec3 away = lightPosition - position;
  const float cosine = dot(surface.normal, away) / max(length(away), 1e-30);
  if (cosine > 0.0 && isLit(1, place, surface.normal, triangle)) surface.light += lightStrength * cosine * material.albedo;
#endif
  return surface;
}

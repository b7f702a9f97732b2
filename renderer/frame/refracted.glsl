// SPDX-License-Identifier: BSD-3-Clause
// Where light goes that a surface lets through. See mirror_rays.h.
#include "renderer/frame/mirrored.glsl"
#include "renderer/frame/surface_point.glsl"

// Direction in which a ray is followed through the surface, or mirrored where nothing passes (total internal reflection).
// The material's index is that of the side behind the triangle's front, relative to the other.
vec3 refracted(SurfacePoint point, SurfaceMaterial material, out bool passes) {
  const uvec3 vertices = sceneTriangle(point.triangle);
  const vec3 corner = scenePosition(vertices.x), e1 = scenePosition(vertices.y) - corner,
             e2 = scenePosition(vertices.z) - corner, reach = max(abs(e1), abs(e2));
  // Scaled before the product: squares of a tiny scene's areas would leave float's range.
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  const bool enters = dot(cross(e1 * unit, e2 * unit), point.flatNormal) > 0.0;
  const vec3 through =
      refract(-point.view, point.normal, enters ? 1.0 / material.refractiveIndex : material.refractiveIndex);
  passes = dot(through, through) > 0.25;
  if (!passes) return mirrored(point.view, point.normal, point.flatNormal);
  // A shading normal bent past the silhouette would send it back.
  return dot(through, point.flatNormal) < 0.0 ? normalize(through) : -point.view;
}

// SPDX-License-Identifier: BSD-3-Clause
// The point of a surface that a pixel sees or that a ray meets. The including shader declares `sizePx` before, and its
// program is compiled with surfaceDefines() and set up by configureSurfacePoints() (see surface_point.h).
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/frame/seen_point.glsl"
#include "renderer/frame/surface_buffers.glsl"

uniform mat4 anchorToCamera, cameraToAnchor;
uniform vec2 rayScale;  // half the image's extents at distance 1
uniform vec3 eye;       // that sees highlights, relative to the anchor

struct SurfacePoint {
  vec3 position;    // relative to the anchor
  vec3 view;        // unit, towards the viewer
  vec3 flatNormal;  // of the triangle's plane: unit, turned to the viewer
  vec3 normal;      // for shading: unit, on the side of the triangle that the viewer is on
  vec3 weights;     // barycentric coordinates; 0 where no attribute needs them
  uint triangle;
};

// Normal of the surface that the triangle stands for, anchor space; `flat` where it has none of its own.
vec3 shadingNormal(SurfaceMaterial material, uvec3 vertices, vec3 weights, vec3 flatNormal) {
  vec3 normal = vec3(0.0);
#ifdef ATTRIBUTES
  if (material.surface == kSurfacePatch) {
    const vec2 uv = weights.x * surfaceAttributes[vertices.x].xy + weights.y * surfaceAttributes[vertices.y].xy +
                    weights.z * surfaceAttributes[vertices.z].xy;
    normal = patchNormal(material.patchPoints, uv);
  }
#endif
#ifdef NORMALS
  if (material.surface != kSurfacePatch)
    normal = weights.x * surfaceNormal(vertices.x) + weights.y * surfaceNormal(vertices.y) +
             weights.z * surfaceNormal(vertices.z);
#endif
  // Scaled first: squares of a tiny patch's derivatives would leave float's range.
  const float reach = max(abs(normal.x), max(abs(normal.y), abs(normal.z)));
  if (!(reach > 0.0)) return flatNormal;
  return normalize(normal / reach);
}

// `flatNormal`: unit; `winding`: the triangle's normal by the order of its vertices, of any length.
vec3 sidedNormal(uint id, uvec3 vertices, vec3 weights, vec3 flatNormal, vec3 winding) {
#ifdef SMOOTH
  const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[id]];
  const vec3 normal = shadingNormal(material, vertices, weights, flatNormal);
  // The triangle decides between front and back; a shading normal bent past the silhouette keeps its side. Terrain
  // has but one side: its skirts are lit as the border that they hang from, whichever way they are seen.
  return material.surface != kSurfaceAperture && dot(winding, flatNormal) < 0.0 ? -normal : normal;
#else
  return flatNormal;
#endif
}

// What a pixel sees of triangle `id`.
SurfacePoint surfaceSeen(ivec2 pixel, uint id, out SeenPoint seen) {
  const uvec3 vertices = sceneTriangle(id);
  const vec3 a = (anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz;
  const vec3 b = (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz;
  const vec3 c = (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz;
  seen = pointSeen(a, b, c, pixelRay(pixel, rayScale, sizePx));
  SurfacePoint point;
  point.triangle = id;
  point.position = (cameraToAnchor * vec4(seen.position, 1.0)).xyz;
  const vec3 towardsEye = eye - point.position;
  point.view = dot(towardsEye, towardsEye) > 0.0 ? normalize(towardsEye) : vec3(0.0, 1.0, 0.0);
  point.flatNormal = mat3(cameraToAnchor) * seen.normal;
  // A triangle without area that a pixel sees all the same.
  if (!(dot(point.flatNormal, point.flatNormal) > 0.5)) point.flatNormal = point.view;
  point.weights = vec3(0.0);
#if defined(SMOOTH) || defined(ATTRIBUTES)
  point.weights = barycentrics(a, b, c, seen.position);
#endif
  point.normal =
      sidedNormal(id, vertices, point.weights, point.flatNormal, mat3(cameraToAnchor) * cross(b - a, c - a));
  return point;
}

// Where a ray along the unit vector `direction` meets triangle `id`, at the barycentric coordinates `weights`.
SurfacePoint surfaceHit(uint id, vec3 weights, vec3 direction) {
  const uvec3 vertices = sceneTriangle(id);
  const vec3 a = scenePosition(vertices.x), b = scenePosition(vertices.y), c = scenePosition(vertices.z);
  SurfacePoint point;
  point.triangle = id;
  point.weights = weights;
  point.position = weights.x * a + weights.y * b + weights.z * c;
  point.view = -direction;
  // Scaled before the product: squares of a tiny scene's areas would leave float's range.
  const vec3 e1 = b - a, e2 = c - a, reach = max(abs(e1), abs(e2));
  const float unit = 1.0 / max(reach.x, max(reach.y, reach.z));
  const vec3 winding = cross(e1 * unit, e2 * unit);
  point.flatNormal = dot(winding, winding) > 0.0 ? normalize(winding) : point.view;
  if (dot(point.flatNormal, point.view) < 0.0) point.flatNormal = -point.flatNormal;
  point.normal = sidedNormal(id, vertices, weights, point.flatNormal, winding);
  return point;
}

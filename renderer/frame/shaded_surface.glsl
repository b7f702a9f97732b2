// SPDX-License-Identifier: BSD-3-Clause
// Colour of a triangle in a pixel. LIT, PATTERN, SMOOTH, NORMALS, ATTRIBUTES: see shaded.cpp.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/aperture.glsl"
#include "renderer/frame/pattern.glsl"
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/frame/seen_point.glsl"
#include "renderer/frame/surface_buffers.glsl"

uniform mat4 anchorToCamera, cameraToAnchor;
uniform vec2 rayScale;  // half the image's extents at distance 1
uniform ivec2 sizePx;
uniform vec3 background;
uniform vec3 lightPosition, eye;  // light's centre and the eye that sees highlights, relative to the anchor
uniform float ambient, diffuse, specular, shininess;
uniform float sunRadius;  // angular radius of the light seen from the scene, rad

vec3 patterned(SurfaceMaterial material, vec3 position) {
#ifdef PATTERN
  if (material.pattern == kPatternNone) return material.albedo;
  const vec3 at = (position - material.patternOrigin) * material.patternFrequency;
  const float s = material.pattern == kPatternChecker ? checker(at) : fractalNoise(at, material.patternOctaves);
  return clamp(material.albedo * (1.0 + material.patternContrast * s), 0.0, 1.0);
#else
  return material.albedo;
#endif
}

// Normal of the surface that the triangle stands for, anchor space; `flat` where it has none of its own.
vec3 shadingNormal(SurfaceMaterial material, uvec3 vertices, vec3 weights, vec3 flatNormal) {
  vec3 normal = vec3(0.0);
#ifdef ATTRIBUTES
  if (material.surface == kSurfacePatch) {
    const vec2 uv = weights.x * surfaceAttributes[vertices.x].xy + weights.y * surfaceAttributes[vertices.y].xy +
                    weights.z * surfaceAttributes[vertices.z].xy;
    normal = patchNormal(material.patchIndex, uv);
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

// A triangle's corners in camera space, and where the ray through a pixel's centre meets it.
struct SurfaceSeen {
  uvec3 vertices;
  vec3 a, b, c;
  SeenPoint at;
};

SurfaceSeen surfaceSeen(uint triangle, ivec2 pixel) {
  SurfaceSeen s;
  s.vertices = sceneTriangle(triangle);
  s.a = (anchorToCamera * vec4(scenePosition(s.vertices.x), 1.0)).xyz;
  s.b = (anchorToCamera * vec4(scenePosition(s.vertices.y), 1.0)).xyz;
  s.c = (anchorToCamera * vec4(scenePosition(s.vertices.z), 1.0)).xyz;
  s.at = pointSeen(s.a, s.b, s.c, pixelRay(pixel, rayScale, sizePx));
  return s;
}

// `lit`: 0 where the first light is in shadow, 1 elsewhere.
vec3 surfaceColour(uint triangle, SurfaceSeen s, float lit) {
  const vec3 position = (cameraToAnchor * vec4(s.at.position, 1.0)).xyz;
  const vec3 towardsEye = eye - position;
  const vec3 view = dot(towardsEye, towardsEye) > 0.0 ? normalize(towardsEye) : vec3(0.0, 1.0, 0.0);
  const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[triangle]];
  vec3 normal = mat3(cameraToAnchor) * s.at.normal;
  // A triangle without area that a pixel sees all the same.
  if (!(dot(normal, normal) > 0.5)) normal = view;
  vec3 weights = vec3(0.0);
#if defined(SMOOTH) || defined(ATTRIBUTES)
  weights = barycentrics(s.a, s.b, s.c, s.at.position);
#endif
#ifdef SMOOTH
  normal = shadingNormal(material, s.vertices, weights, normal);
  // The triangle decides between front and back; a shading normal bent past the silhouette keeps its side. Terrain
  // has but one side: its skirts are lit as the border that they hang from, whichever way they are seen.
  if (material.surface != kSurfaceAperture && dot(cross(s.b - s.a, s.c - s.a), s.at.normal) < 0.0) normal = -normal;
#endif
  const vec3 albedo = patterned(material, position);
  float sky = 1.0, sun = 1.0;
#ifdef LIT
  const vec3 away = lightPosition - position;
  const vec3 toLight = dot(away, away) > 0.0 ? normalize(away) : normal;
  sun = material.surface == kSurfaceAperture ? 1.0 : lit;
#else
  const vec3 toLight = normal;
#endif
#ifdef ATTRIBUTES
  if (material.surface == kSurfaceAperture) {
    const vec4 aperture = weights.x * surfaceAttributes[s.vertices.x] + weights.y * surfaceAttributes[s.vertices.y] +
                          weights.z * surfaceAttributes[s.vertices.z];
    const vec2 light = apertureLight(aperture, normal, toLight, sunRadius);
    sun = light.x;
    sky = light.y;
  }
#endif
  vec3 colour = ambient * sky * albedo;
#ifdef LIT
  const float cosine = dot(normal, toLight);
  if (cosine > 0.0) {
    colour += diffuse * cosine * sun * albedo;
    const float highlight = dot(normal, normalize(toLight + view));
    if (specular > 0.0 && highlight > 0.0) colour += specular * sun * pow(highlight, shininess);
  }
#endif
  return colour;
}

// SPDX-License-Identifier: BSD-3-Clause
// Colour of the surface that a pixel sees, from its triangle. See shaded.h. The including shader declares `sizePx` before, and
// defines sunShare().
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/aperture.glsl"
#include "renderer/frame/pattern.glsl"
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/frame/seen_point.glsl"
#include "renderer/frame/surface_buffers.glsl"

uniform mat4 anchorToCamera, cameraToAnchor;
uniform vec2 rayScale;  // half the image's extents at distance 1
uniform vec3 background;
uniform vec3 lightPosition, eye;  // light's centre and the eye that sees highlights, relative to the anchor
uniform float ambient, diffuse, specular, shininess;
uniform float sunRadius;  // angular radius of the light seen from the scene, rad

#ifdef LIT
// Share of the light that reaches the point which a pixel sees.
float sunShare(ivec2 pixel, SeenPoint seen);
#endif

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

// Of a surface that the shares `sky` and `sun` of the light reach; unit vectors.
vec3 litColour(vec3 albedo, vec3 normal, vec3 toLight, vec3 view, float sky, float sun) {
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

// Towards the light's centre; `normal` if there is none.
vec3 towardsLight(vec3 position, vec3 normal) {
#ifdef LIT
  const vec3 away = lightPosition - position;
  if (dot(away, away) > 0.0) return normalize(away);
#endif
  return normal;
}

// `id`: triangle that the pixel sees; 0xffffffff: none.
vec3 shadedColour(ivec2 pixel, uint id) {
  if (id == 0xffffffffu) return background;
  const uvec3 vertices = sceneTriangle(id);
  const vec3 a = (anchorToCamera * vec4(scenePosition(vertices.x), 1.0)).xyz;
  const vec3 b = (anchorToCamera * vec4(scenePosition(vertices.y), 1.0)).xyz;
  const vec3 c = (anchorToCamera * vec4(scenePosition(vertices.z), 1.0)).xyz;
  const SeenPoint seen = pointSeen(a, b, c, pixelRay(pixel, rayScale, sizePx));
  const vec3 position = (cameraToAnchor * vec4(seen.position, 1.0)).xyz;
  const vec3 towardsEye = eye - position;
  const vec3 view = dot(towardsEye, towardsEye) > 0.0 ? normalize(towardsEye) : vec3(0.0, 1.0, 0.0);
  const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[id]];
  vec3 normal = mat3(cameraToAnchor) * seen.normal;
  // A triangle without area that a pixel sees all the same.
  if (!(dot(normal, normal) > 0.5)) normal = view;
  vec3 weights = vec3(0.0);
#if defined(SMOOTH) || defined(ATTRIBUTES)
  weights = barycentrics(a, b, c, seen.position);
#endif
#ifdef SMOOTH
  normal = shadingNormal(material, vertices, weights, normal);
  // The triangle decides between front and back; a shading normal bent past the silhouette keeps its side. Terrain
  // has but one side: its skirts are lit as the border that they hang from, whichever way they are seen.
  if (material.surface != kSurfaceAperture && dot(cross(b - a, c - a), seen.normal) < 0.0) normal = -normal;
#endif
  const vec3 albedo = patterned(material, position);
  float sky = 1.0, sun = 1.0;
  const vec3 toLight = towardsLight(position, normal);
#ifdef LIT
  sun = material.surface == kSurfaceAperture ? 1.0 : sunShare(pixel, seen);
#endif
#ifdef ATTRIBUTES
  if (material.surface == kSurfaceAperture) {
    const vec4 aperture = weights.x * surfaceAttributes[vertices.x] + weights.y * surfaceAttributes[vertices.y] +
                          weights.z * surfaceAttributes[vertices.z];
    const vec2 light = apertureLight(aperture, normal, toLight, sunRadius);
    sun = light.x;
    sky = light.y;
  }
#endif
  return litColour(albedo, normal, toLight, view, sky, sun);
}

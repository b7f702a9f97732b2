// SPDX-License-Identifier: BSD-3-Clause
// Colour of the surface that a pixel sees, from its triangle. See shaded.h. The including shader declares `sizePx` before, and
// defines sunShare().
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/aperture.glsl"
#include "renderer/frame/pattern.glsl"
#include "renderer/frame/surface_point.glsl"

uniform vec3 background;
uniform vec3 lightPosition;  // of the light's centre, relative to the anchor
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

// Of a point that the share `sun` of the light reaches.
vec3 pointColour(SurfacePoint point, float sun) {
  const SurfaceMaterial material = surfaceMaterials[surfaceMaterialOf[point.triangle]];
  const vec3 toLight = towardsLight(point.position, point.normal);
  float sky = 1.0;
#ifdef ATTRIBUTES
  if (material.surface == kSurfaceAperture) {
    const uvec3 vertices = sceneTriangle(point.triangle);
    const vec4 aperture = point.weights.x * surfaceAttributes[vertices.x] +
                          point.weights.y * surfaceAttributes[vertices.y] +
                          point.weights.z * surfaceAttributes[vertices.z];
    const vec2 light = apertureLight(aperture, point.normal, toLight, sunRadius);
    sun = light.x;
    sky = light.y;
  }
#endif
  return litColour(patterned(material, point.position), point.normal, toLight, point.view, sky, sun);
}

// `id`: triangle that the pixel sees; 0xffffffff: none.
vec3 shadedColour(ivec2 pixel, uint id) {
  if (id == 0xffffffffu) return background;
  SeenPoint seen;
  const SurfacePoint point = surfaceSeen(pixel, id, seen);
  float sun = 1.0;
#ifdef LIT
  if (surfaceMaterials[surfaceMaterialOf[id]].surface != kSurfaceAperture) sun = sunShare(pixel, seen);
#endif
  return pointColour(point, sun);
}

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

#ifdef PATTERN_WIDTH
// Patterns are the mean over a square of this width on the surface, world units; set both before.
float patternWidth = 0.0;
vec3 patternNormal = vec3(0.0);
#endif
#ifdef FILTERED_PATTERN
vec3 patternSideA = vec3(0.0), patternSideB = vec3(0.0);  // of the part of the surface over which checks are averaged
#endif

vec3 patterned(SurfaceMaterial material, vec3 position) {
#ifdef PATTERN
  if (material.pattern == kPatternNone) return material.albedo;
  const vec3 at = (position - material.patternOrigin) * material.patternFrequency;
#if defined(PATTERN_WIDTH)
  // Along each axis of the solid texture as far as the surface extends along it.
  const vec3 wide = patternWidth * material.patternFrequency * sqrt(max(1.0 - patternNormal * patternNormal, 0.0));
  const float s = material.pattern == kPatternChecker
                      ? checkerOver(at, wide)
                      : fractalNoiseOver(at, material.patternOctaves, max(wide.x, max(wide.y, wide.z)));
#elif defined(FILTERED_PATTERN)
  const float s = material.pattern == kPatternChecker
                      ? checkerWithin(at, patternSideA * material.patternFrequency, patternSideB * material.patternFrequency)
                      : fractalNoise(at, material.patternOctaves);
#else
  const float s = material.pattern == kPatternChecker ? checker(at) : fractalNoise(at, material.patternOctaves);
#endif
  return clamp(material.albedo * (1.0 + material.patternContrast * s), 0.0, 1.0);
#else
  return material.albedo;
#endif
}

#ifdef HIGHLIGHT_COOK_TORRANCE
uniform float roughness, normalReflectance;

// pi times the reflectance by microfacets, times the cosine of the light (Roger 2008, equation 1.11, with the cosines in the
// denominator): Schlick's Fresnel term, Beckmann's distribution, the geometric term of Torrance and Sparrow. The distribution
// has the factor 1/4 of Cook and Torrance 1981; without it surfaces would reflect up to four times what they receive.
float cookTorrance(vec3 normal, vec3 toLight, vec3 view) {
  const vec3 middle = toLight + view;
  if (!(dot(middle, middle) > 0.0)) return 0.0;
  const vec3 h = normalize(middle);
  const float nh = dot(normal, h), nv = dot(normal, view), nl = dot(normal, toLight), vh = dot(view, h);
  if (!(nh > 0.0 && nv > 0.0 && nl > 0.0 && vh > 0.0)) return 0.0;
  const float rest = 1.0 - min(vh, 1.0), squared = rest * rest;
  const float fresnel = normalReflectance + (1.0 - normalReflectance) * squared * squared * rest;
  const float cosine2 = min(nh * nh, 1.0), m2 = roughness * roughness;
  const float facets = exp((cosine2 - 1.0) / (cosine2 * m2)) / (4.0 * m2 * cosine2 * cosine2);
  const float unshadowed = min(1.0, min(2.0 * nh * nv / vh, 2.0 * nh * nl / vh));
  return fresnel * facets * unshadowed / nv;
}
#endif

// Of a surface that the shares `sky` and `sun` of the light reach; unit vectors.
vec3 litColour(vec3 albedo, vec3 normal, vec3 toLight, vec3 view, float sky, float sun) {
  vec3 colour = ambient * sky * albedo;
#ifdef LIT
  const float cosine = dot(normal, toLight);
  if (cosine > 0.0) {
    colour += diffuse * cosine * sun * albedo;
#if defined(HIGHLIGHT_PHONG)
    const float highlight = dot(2.0 * dot(normal, view) * normal - view, toLight);
    if (specular > 0.0 && highlight > 0.0) colour += specular * sun * pow(highlight, shininess);
#elif defined(HIGHLIGHT_COOK_TORRANCE)
    if (specular > 0.0) colour += specular * sun * cookTorrance(normal, toLight, view);
#else
    const float highlight = dot(normal, normalize(toLight + view));
    if (specular > 0.0 && highlight > 0.0) colour += specular * sun * pow(highlight, shininess);
#endif
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

// SPDX-License-Identifier: BSD-3-Clause
// Colour of each pixel from the triangle that it sees. See shaded.h.
#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/aperture.glsl"
#include "renderer/frame/pattern.glsl"
#include "renderer/frame/scene_buffers.glsl"
#include "renderer/frame/seen_point.glsl"
#include "renderer/frame/surface_buffers.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kShadedIdsUnit) uniform usampler2D triangleIds;
layout(binding = kShadedOutImage, rgba32f) uniform writeonly image2D outImage;
#ifdef SHADOW
layout(binding = kShadedReceiversUnit) uniform sampler2D receivers;
layout(binding = kShadedShadowMapUnit) uniform sampler2D shadowMap;
uniform vec2 tangentLow, tangentSize;
uniform int resolution;
uniform float bias, slopeBias, maxSlope;
#endif

uniform mat4 anchorToCamera, cameraToAnchor;
uniform vec2 rayScale;  // half the image's extents at distance 1
uniform ivec2 sizePx;
uniform vec3 background;
uniform vec3 lightPosition, eye;  // light's centre and the eye that sees highlights, relative to the anchor
uniform float ambient, diffuse, specular, shininess;
uniform float sunRadius;  // angular radius of the light seen from the scene, rad

const uint kNone = 0xffffffffu;

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

float shadowOf(ivec2 pixel) {
#ifdef SHADOW
  const vec4 receiver = texelFetch(receivers, pixel, 0);
  if (receiver.w < 0.0) return 0.0;  // averted from the light
  const vec2 at = (receiver.xy / receiver.z - tangentLow) / tangentSize * float(resolution);
  if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(float(resolution)))))) return 1.0;
  const float texel = max(tangentSize.x, tangentSize.y) / float(resolution);
  const float slope = min(receiver.w, maxSlope * receiver.z);
  const float biased = receiver.z - bias * receiver.z - slopeBias * slope * texel;
  return texelFetch(shadowMap, ivec2(at), 0).x < biased ? 0.0 : 1.0;
#else
  return 1.0;
#endif
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const uint id = texelFetch(triangleIds, pixel, 0).x;
  vec3 colour = background;
  if (id != kNone) {
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
#ifdef LIT
    const vec3 away = lightPosition - position;
    const vec3 toLight = dot(away, away) > 0.0 ? normalize(away) : normal;
    sun = material.surface == kSurfaceAperture ? 1.0 : shadowOf(pixel);
#else
    const vec3 toLight = normal;
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
    colour = ambient * sky * albedo;
#ifdef LIT
    const float cosine = dot(normal, toLight);
    if (cosine > 0.0) {
      colour += diffuse * cosine * sun * albedo;
      const float highlight = dot(normal, normalize(toLight + view));
      if (specular > 0.0 && highlight > 0.0) colour += specular * sun * pow(highlight, shininess);
    }
#endif
  }
  imageStore(outImage, pixel, vec4(colour, 1.0));
}

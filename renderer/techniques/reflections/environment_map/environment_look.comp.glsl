// SPDX-License-Identifier: BSD-3-Clause
// What the map holds for each pixel's mirrored ray. See environment_map.cpp.
#include "renderer/techniques/reflections/reflection_bindings.h"
#include "renderer/techniques/reflections/environment_map/cube_faces.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReflectionOriginsUnit) uniform sampler2D origins;
layout(binding = kReflectionDirectionsUnit) uniform sampler2D directions;
layout(binding = kEnvironmentCubeUnit) uniform samplerCube map;
layout(binding = kEnvironmentFacesUnit) uniform sampler2DArray faces;  // with distances
layout(binding = kEnvironmentMapFacesUnit) uniform sampler2DArray mapFaces;
#if LAYERS > 1
layout(binding = kEnvironmentSecondCubeUnit) uniform samplerCube secondMap;
layout(binding = kEnvironmentSecondFacesUnit) uniform sampler2DArray secondFaces;
#endif
#ifdef UNDER
layout(binding = kReflectionImage, rgba32f) uniform image2D outImage;  // colours multiplied by alpha
#else
layout(binding = kReflectionImage, rgba32f) uniform writeonly image2D outImage;
#endif
layout(binding = kEnvironmentFateImage, r32ui) uniform writeonly uimage2D fates;

uniform ivec2 sizePx;
uniform int resolution, mapResolution;  // of `faces`; of the map, which may be filtered
uniform vec3 centre;
uniform float radius;  // FINITE
#if LAYERS > 0
uniform int steps, refinements;
uniform float reach, crackShare;
#endif

// Of nothing where there is no direction, for which a driver may read anywhere.
vec3 looked(vec3 direction, float level, int layer) {
  if (!isDirection(direction)) return vec3(0.0);
#if FILTER == FILTER_NEAREST
#if LAYERS > 1
  if (layer == 1) return texelFetch(secondFaces, cubeTexel(direction, resolution), 0).rgb;
#endif
  return texelFetch(mapFaces, cubeTexel(direction, mapResolution), 0).rgb;
#else
#if LAYERS > 1
  if (layer == 1) return textureLod(secondMap, direction, level).rgb;
#endif
  return textureLod(map, direction, level).rgb;
#endif
}

// Mip level at which a texel is as wide as the angle to the neighbouring pixel's ray.
float levelOf(ivec2 pixel, vec3 direction) {
#if FILTER == FILTER_MIP
  float widest = 0.0;
  for (int axis = 0; axis < 2; ++axis)
    for (int side = -1; side <= 1; side += 2) {
      const ivec2 at = pixel + (axis == 0 ? ivec2(side, 0) : ivec2(0, side));
      if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, sizePx)) || texelFetch(origins, at, 0).w == 0.0) continue;
      widest = max(widest, length(texelFetch(directions, at, 0).xyz - direction));
      break;
    }
  return max(log2(widest * float(mapResolution) / 1.5707963), 0.0);
#else
  return 0.0;
#endif
}

#if LAYERS > 0
// Distance of a layer's surface beyond a point, less the point's own; infinite where there is none. < 0: the point is behind it.
float beyond(vec3 at, int layer) {
  if (!isDirection(at)) return 3.0e38;
  const ivec3 texel = cubeTexel(at, resolution);
#if LAYERS > 1
  const float there = layer == 0 ? texelFetch(faces, texel, 0).a : texelFetch(secondFaces, texel, 0).a;
#else
  const float there = texelFetch(faces, texel, 0).a;
#endif
  return there > 0.0 ? there - length(at) : 3.0e38;
}

// Where a ray meets the surfaces that the map's distances describe, the first of them. True if it does. A crack: the ray slips
// behind the last layer that the map has, where it may meet what the map does not know.
bool meets(vec3 from, vec3 direction, out vec3 at, out int met, out uint cracks) {
  cracks = 0u;
  float before = 0.0;
  bool behind[LAYERS];
  for (int layer = 0; layer < LAYERS; ++layer) behind[layer] = beyond(from, layer) < 0.0;
  for (int i = 1; i <= steps; ++i) {
    // Dense near the mirror, towards infinity at the end.
    const float s = float(i) / float(steps + 1);
    const float t = reach * s / (1.0 - s);
    float nearest = 3.0e38;
    for (int layer = 0; layer < LAYERS; ++layer) {
      const bool now = beyond(from + t * direction, layer) < 0.0;
      if (now && !behind[layer]) {
        float low = before, high = t;
        for (int k = 0; k < refinements; ++k) {
          const float middle = 0.5 * (low + high);
          if (beyond(from + middle * direction, layer) < 0.0)
            high = middle;
          else
            low = middle;
        }
        const vec3 there = from + high * direction;
        // Behind a surface by more than steps explain: the ray slips behind an object's border.
        if (-beyond(there, layer) <= crackShare * length(there)) {
          if (high < nearest) {
            nearest = high;
            at = there;
            met = layer;
          }
        } else if (layer == LAYERS - 1) {
          ++cracks;
        }
      }
      behind[layer] = now;
    }
    if (nearest < 3.0e38) return true;
    before = t;
  }
  return false;
}
#endif

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const vec4 origin = texelFetch(origins, pixel, 0);
  uint fate = kEnvironmentNoRay;
  if (origin.w > 0.0) {
    const vec3 direction = texelFetch(directions, pixel, 0).xyz;
    const float level = levelOf(pixel, direction);
    vec3 towards = direction;
    fate = kEnvironmentMet;
    int layer = 0;
#ifdef FINITE
    towards = radius * direction + (origin.xyz - centre);
#endif
#if LAYERS > 0
    vec3 at;
    uint cracks;
    if (meets(origin.xyz - centre, direction, at, layer, cracks)) {
      towards = at;
      if (cracks > 0u) fate = kEnvironmentMetBehindCrack;
    } else {
      fate = cracks > 0u ? kEnvironmentCrack : kEnvironmentMissed;
    }
#endif
    vec4 light = vec4(looked(towards, level, layer), 1.0);
#ifdef UNDER
    const vec4 brought = imageLoad(outImage, pixel);
    light = brought + (1.0 - brought.a) * light;
#endif
    imageStore(outImage, pixel, light);
  }
#ifdef COUNT
  imageStore(fates, pixel, uvec4(fate));
#endif
}

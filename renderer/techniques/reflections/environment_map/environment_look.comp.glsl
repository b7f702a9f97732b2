// SPDX-License-Identifier: BSD-3-Clause
// What the map holds for each pixel's mirrored ray. See environment_map.cpp.
#include "renderer/techniques/reflections/reflection_bindings.h"
#include "renderer/techniques/reflections/environment_map/cube_faces.glsl"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kReflectionOriginsUnit) uniform sampler2D origins;
layout(binding = kReflectionDirectionsUnit) uniform sampler2D directions;
layout(binding = kEnvironmentCubeUnit) uniform samplerCube map;
layout(binding = kEnvironmentFacesUnit) uniform sampler2DArray faces;
layout(binding = kReflectionImage, rgba32f) uniform writeonly image2D outImage;
layout(binding = kEnvironmentFateImage, r32ui) uniform writeonly uimage2D fates;

uniform ivec2 sizePx;
uniform int resolution;
uniform vec3 centre;
uniform float radius;  // FINITE
#ifdef DEPTH
uniform int steps, refinements;
uniform float reach, crackShare;
#endif

vec3 looked(vec3 direction, float level) {
#if FILTER == FILTER_NEAREST
  return texelFetch(faces, cubeTexel(direction, resolution), 0).rgb;
#else
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
  return max(log2(widest * float(resolution) / 1.5707963), 0.0);
#else
  return 0.0;
#endif
}

#ifdef DEPTH
// Distance of the surface beyond a point, less the point's own; infinite where there is none. < 0: the point is behind it.
float beyond(vec3 at) {
  const float there = texelFetch(faces, cubeTexel(at, resolution), 0).a;
  return there > 0.0 ? there - length(at) : 3.0e38;
}

// Where a ray meets the surface that the map's distances describe. True if it does.
bool meets(vec3 from, vec3 direction, out vec3 at, out uint cracks) {
  cracks = 0u;
  float before = 0.0;
  bool behind = beyond(from) < 0.0;
  for (int i = 1; i <= steps; ++i) {
    // Dense near the mirror, towards infinity at the end.
    const float s = float(i) / float(steps + 1);
    const float t = reach * s / (1.0 - s);
    const bool now = beyond(from + t * direction) < 0.0;
    if (now && !behind) {
      float low = before, high = t;
      for (int k = 0; k < refinements; ++k) {
        const float middle = 0.5 * (low + high);
        if (beyond(from + middle * direction) < 0.0)
          high = middle;
        else
          low = middle;
      }
      at = from + high * direction;
      const float gap = -beyond(at);
      // Behind a surface by more than steps explain: the ray slips behind an object's border.
      if (gap <= crackShare * length(at)) return true;
      ++cracks;
    }
    behind = now;
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
#ifdef FINITE
    towards = radius * direction + (origin.xyz - centre);
#endif
#ifdef DEPTH
    vec3 at;
    uint cracks;
    if (meets(origin.xyz - centre, direction, at, cracks)) {
      towards = at;
      if (cracks > 0u) fate = kEnvironmentMetBehindCrack;
    } else {
      fate = cracks > 0u ? kEnvironmentCrack : kEnvironmentMissed;
    }
#endif
    imageStore(outImage, pixel, vec4(looked(towards, level), 1.0));
  }
#ifdef COUNT
  imageStore(fates, pixel, uvec4(fate));
#endif
}

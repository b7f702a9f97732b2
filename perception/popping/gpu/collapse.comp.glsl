// SPDX-License-Identifier: BSD-3-Clause
// The finest level's response difference, then the Minkowski sum over all levels and channels, and weights: the
// difference map.
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/gpu/masking.glsl"
#include "perception/popping/gpu/stages.glsl"
#ifdef MASKING_NEIGHBOURHOOD
#include "perception/popping/gpu/neighbourhood.glsl"
#else
#include "perception/popping/gpu/response.glsl"
#endif

layout(binding = kCollapseDifferencesUnit) uniform sampler2D differences;  // contrast level i at mip level i - 1
layout(binding = kCollapseDisocclusionUnit) uniform sampler2D disocclusion;
layout(binding = kCollapseFlickerUnit) uniform sampler2D flicker;
layout(binding = kCollapseJndImage, r32f) uniform writeonly image2D jnd;

uniform int contrastLevels;
uniform float exponent;
uniform ivec2 hasWeight;
uniform int shown;  // 0: the difference map, 1: before weighting, 2: the weight, 3: signed

float raised(float value) { return value == 0.0 ? 0.0 : pow(abs(value), exponent); }

vec3 coarseDifference(ivec2 pixel, int from) {
  ivec2 size = textureSize(differences, from - 1), first = pixel >> from;
  vec2 weight = vec2(pixel - (first << from)) / float(1 << from);
  ivec2 second = min(first + 1, size - 1);
  first = min(first, size - 1);
  vec3 above = mix(texelFetch(differences, first, from - 1).xyz,
                   texelFetch(differences, ivec2(second.x, first.y), from - 1).xyz, weight.x);
  vec3 below = mix(texelFetch(differences, ivec2(first.x, second.y), from - 1).xyz,
                   texelFetch(differences, second, from - 1).xyz, weight.x);
  return mix(above, below, weight.y);
}

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  bool inside = all(lessThan(pixel, imageSize(jnd)));
  float sum = 0.0, signedSum = 0.0;
  if (contrastLevels > 0) prepare();
  if (inside && contrastLevels > 0) {
    Stages unused;
    vec3 finest = responseDifference(pixel, 0, unused);
    for (int c = 0; c < 3; ++c) {
      float power = raised(finest[c]);
      sum += power;
      signedSum += sign(finest[c]) * power;
    }
  }
  if (inside)
    for (int from = 1; from < contrastLevels; ++from) {
      vec3 value = coarseDifference(pixel, from);
      for (int c = 0; c < 3; ++c) {
#ifdef COLLAPSE_MAGNITUDE
        sum += value[c];
#else
        float power = raised(value[c]);
        sum += power;
        signedSum += sign(value[c]) * power;
#endif
      }
    }
  if (inside) {
    float weight = 1.0;
    for (int i = 0; i < 2; ++i) {
      if (hasWeight[i] == 0) continue;
      float value = i == 0 ? texelFetch(disocclusion, pixel, 0).x : texelFetch(flicker, pixel, 0).x;
      if (!isnan(value) && !isinf(value)) weight *= clamp(value, 0.0, 1.0);
    }
    float difference = (sum > 0.0 ? pow(sum, 1.0 / exponent) : 0.0);
    float value = difference * weight;
    if (shown == 1) value = difference;
    if (shown == 2) value = weight;
    if (shown == 3)
      value = signedSum == 0.0 ? 0.0 : sign(signedSum) * pow(abs(signedSum), 1.0 / exponent) * weight;
    imageStore(jnd, pixel, vec4(value));
  }
  if (contrastLevels > 0) countGuarded();
}

// SPDX-License-Identifier: BSD-3-Clause
// Response difference of the frames at a level of the contrast pyramid.
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/gpu/masking.glsl"
#include "perception/popping/gpu/stages.glsl"
#ifdef MASKING_NEIGHBOURHOOD
#include "perception/popping/gpu/neighbourhood.glsl"
#else
#include "perception/popping/gpu/response.glsl"
#endif

layout(binding = kDifferencesImage, rgba32f) uniform writeonly image2D differences;

uniform float exponent;
uniform int shownFrame, shownStage;  // SHOW_STAGES: contrast, luminance, velocity, response, difference

void main() {
  prepare();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (all(lessThan(pixel, imageSize(differences)))) {
    Stages shown;
    vec3 value = responseDifference(pixel, shownFrame, shown);
#if defined(SHOW_STAGES)
    if (shownStage == 0) value = shown.contrast;
    if (shownStage == 1) value = vec3(shown.luminance);
    if (shownStage == 2) value = vec3(shown.velocity);
    if (shownStage == 3) value = shown.response;
#elif defined(COLLAPSE_MAGNITUDE)
    for (int c = 0; c < 3; ++c) value[c] = value[c] == 0.0 ? 0.0 : pow(abs(value[c]), exponent);
#endif
    imageStore(differences, pixel, vec4(value, 0.0));
  }
#ifndef SHOW_STAGES
  countGuarded();
#endif
}

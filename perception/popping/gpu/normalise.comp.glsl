// SPDX-License-Identifier: BSD-3-Clause
// Contrasts of both frames over their thresholds at a level of the contrast pyramid, for neighbourhood.glsl.
#define STORE_NORMALISED
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/gpu/masking.glsl"
#include "perception/popping/gpu/stages.glsl"
#include "perception/popping/gpu/response.glsl"

void main() {
  prepare();
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  Stages unused;
  if (all(lessThan(pixel, imageSize(normalisedImage).xy))) responseDifference(pixel, 0, unused);
  countGuarded();
}

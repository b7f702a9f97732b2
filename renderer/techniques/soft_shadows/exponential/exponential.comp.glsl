// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/prefiltered_window.glsl"

float estimate(vec2 low, vec2 high, float depth) {
  fetchCount += kAverageFetches;
  // Clamped: what lies beyond the receiver counts for more than one, and sums of floats may come out below zero.
  return clamp(boxMean(low, high, 0).x * exp(exponent * (kUnitDepth - depth)), 0.0, 1.0);
}

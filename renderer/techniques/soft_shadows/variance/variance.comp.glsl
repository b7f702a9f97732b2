// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/prefiltered_window.glsl"
#include "renderer/techniques/soft_shadows/variance/chebyshev.glsl"

uniform float minVariance, bleedClamp;

float estimate(vec2 low, vec2 high, float depth) {
  fetchCount += kAverageFetches;
  return withoutBleeding(chebyshev(boxMean(low, high, 0), depth, minVariance), bleedClamp);
}

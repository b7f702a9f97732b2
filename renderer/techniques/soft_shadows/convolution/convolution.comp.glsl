// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/prefiltered_window.glsl"
#include "renderer/techniques/soft_shadows/convolution/fourier_step.glsl"

uniform float shift;            // in units of where the series peaks first, 1 / 2M
uniform float searchThreshold;  // share of a convolved search's window

// Where the series takes the receiver to be: somewhat nearer to the light, since a texel at its own depth would block by
// half.
float seriesDepth(float depth) { return periodShare * depth - shift * 0.5 / float(terms); }

float estimate(vec2 low, vec2 high, float depth) {
  const float at = seriesDepth(depth);
  float lit = 0.5;
  for (int k = 0; k < terms; ++k) lit += stepTerm(k, termMean(low, high, k), fourierTerm(k, at));
  fetchCount += uint(terms) * kAverageFetches;
  return lit;
}

#ifdef WINDOW_CONVOLVED
// Average depth of what blocks, from averages of the step and of the step times the depth.
float blockerDepth(vec4 receiver, vec2 centre, vec2 size) {
  vec2 low, high;
  cutToMap(centre, size, low, high);
  const float at = seriesDepth(receiverDepth(receiver));
  float blocked = 0.5, depths = 0.5 * boxMean(low, high, 2 * terms).x;
  for (int k = 0; k < terms; ++k) {
    const vec2 there = fourierTerm(k, at);
    blocked -= stepTerm(k, termMean(low, high, k), there);
    depths -= stepTerm(k, termMean(low, high, terms + k), there);
  }
  fetchCount += uint(2 * terms + 1) * kAverageFetches;
  const vec2 inside = (high - low) / size;
  if (!(blocked * inside.x * inside.y > searchThreshold)) return -1.0;
  return depthNear + clamp(depths / blocked, 0.0, 1.0) / depthScale;
}
#endif

// SPDX-License-Identifier: BSD-3-Clause
// Depths as a prefiltered map holds them, and its averages over rectangles. A shader that only fills the map leaves
// SUMS_UNIT undefined.
#include "renderer/frame/frame_bindings.h"

uniform float depthNear, depthScale;
uniform float exponent;     // c
uniform int terms;          // M
uniform float periodShare;  // share of half the series' period that depths from 0 to 1 span

// Light-space z to 0..1. NaN becomes 0: nearest.
float normalisedDepth(float z) { return min(max((z - depthNear) * depthScale, 0.0), 1.0); }

// The depth at which an exponential is 1. In the middle for floats: exp(c / 2) then bounds both ends, and neither c up to
// 88 nor a sum over 2^24 texels leaves the range of 32 bits. Integer formats hold values up to 1 only.
#ifdef SUMS_FIXED
const float kUnitDepth = 1.0;
#else
const float kUnitDepth = 0.5;
#endif

// Term k of the series at a depth t: (cos, sin) of (2 k + 1) pi t. Whole turns are taken off first, which loses nothing and
// keeps the argument where all devices are accurate.
vec2 fourierTerm(int k, float t) {
  const float turns = fract(0.5 * float(2 * k + 1) * t);
  const float angle = 6.28318530718 * (turns - (turns > 0.5 ? 1.0 : 0.0));
  return vec2(cos(angle), sin(angle));
}

// 1 / c_k, with c_k = (2 k + 1) pi.
float fourierWeight(int k) { return 0.318309886184 / float(2 * k + 1); }

#ifdef SUMS_UNIT
#ifdef MIPS
layout(binding = SUMS_UNIT) uniform sampler2DArray averages;
const uint kAverageFetches = 8u;

// Mean over [low, high), texels, by the square of the same area around its middle.
vec2 boxMean(vec2 low, vec2 high, int layer) {
  const float side = float(textureSize(averages, 0).x);
  const vec2 size = max(high - low, vec2(1.0));
  return textureLod(averages, vec3(0.5 * (low + high) / side, float(layer)), 0.5 * log2(size.x * size.y)).xy;
}
#else
#include "renderer/frame/summed_area_table.glsl"
const uint kAverageFetches = kSumFetches;

vec2 boxMean(vec2 low, vec2 high, int layer) {
  return boxSum(low, high, layer) / ((high.x - low.x) * (high.y - low.y));
}
#endif

// Mean of a Fourier term, which integer formats store as (x + 1) / 2.
vec2 termMean(vec2 low, vec2 high, int layer) {
#ifdef SUMS_FIXED
  return 2.0 * boxMean(low, high, layer) - 1.0;
#else
  return boxMean(low, high, layer);
#endif
}
#endif

// SPDX-License-Identifier: BSD-3-Clause
// Sums over rectangles, with fractions of the texels at their rims. Before it is included, SUMS_UNIT names the texture
// unit; SUMS_FIXED and SUMS_MEAN are those of SummedAreaTable::defines().
#include "renderer/frame/frame_bindings.h"

#ifdef SUMS_FIXED
layout(binding = SUMS_UNIT) uniform usampler2DArray sums;
uniform float sumsUnit;  // value of one count
#define SUM uvec2
#else
layout(binding = SUMS_UNIT) uniform sampler2DArray sums;
#define SUM vec2
#endif
#ifdef SUMS_MEAN
layout(std430, binding = kSumsMeansBuffer) readonly buffer SumsMeans { vec2 sumsMeans[]; };
#endif

const uint kSumFetches = 16u;

// Sum of the texels [0, x) x [0, y).
SUM sumBefore(int x, int y, int layer) {
  return min(x, y) > 0 ? SUM(texelFetch(sums, ivec3(x - 1, y - 1, layer), 0).xy) : SUM(0);
}

// Three runs of whole texels along an axis: the first and the last texel that [low, high) meets, and what lies between.
// The runs are [edges.x, edges.y), [edges.y, edges.z), [edges.z, edges.w); `weights` says how much of each counts.
void runsOf(float low, float high, int resolution, out ivec4 edges, out vec3 weights) {
  const int first = clamp(int(floor(low)), 0, resolution - 1), last = clamp(int(floor(high)), 0, resolution);
  if (last <= first) {
    edges = ivec4(first, first + 1, first + 1, first + 1);
    weights = vec3(high - low, 0.0, 0.0);
  } else {
    edges = ivec4(first, first + 1, last, min(last + 1, resolution));
    weights = vec3(float(first + 1) - low, 1.0, high - float(last));
  }
}

// Integral over [low, high), texels, within the map. Sums are subtracted before they are weighted: whole numbers stay
// exact, and floats lose no more than their own rounding.
vec2 boxSum(vec2 low, vec2 high, int layer) {
  const int resolution = textureSize(sums, 0).x;
  ivec4 x, y;
  vec3 weightX, weightY;
  runsOf(low.x, high.x, resolution, x, weightX);
  runsOf(low.y, high.y, resolution, y, weightY);
  SUM below[4];
  for (int i = 0; i < 4; ++i) below[i] = sumBefore(x[i], y[0], layer);
  vec2 total = vec2(0.0);
  for (int j = 0; j < 3; ++j) {
    SUM above[4];
    for (int i = 0; i < 4; ++i) above[i] = sumBefore(x[i], y[j + 1], layer);
    for (int i = 0; i < 3; ++i)
      total += weightX[i] * weightY[j] * vec2((above[i + 1] - above[i]) - (below[i + 1] - below[i]));
    for (int i = 0; i < 4; ++i) below[i] = above[i];
  }
#ifdef SUMS_FIXED
  return total * sumsUnit;
#elif defined(SUMS_MEAN)
  return total + (high.x - low.x) * (high.y - low.y) * sumsMeans[layer];
#else
  return total;
#endif
}

// SPDX-License-Identifier: BSD-3-Clause
// Percentage-closer filtering: the share of taps, on a regular grid over a window of the map, that do not block.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

layout(binding = kShadowMapUnit) uniform sampler2D shadowMap;
uniform int filterTaps;  // along a side

// Tap (i, j) of n x n over a window of `size` texels around `centre`; outside the map nothing blocks.
float tapDepth(vec2 centre, vec2 size, int i, int j, int n) {
  const vec2 at = centre + size * ((vec2(float(i), float(j)) + 0.5) / float(n) - 0.5);
  if (!(all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(float(resolution)))))) return kEmptyDepth;
  return texelFetch(shadowMap, ivec2(at), 0).x;
}

float percentageCloser(vec2 centre, vec2 size, float depth) {
  int open = 0;
  for (int j = 0; j < filterTaps; ++j)
    for (int i = 0; i < filterTaps; ++i) open += tapDepth(centre, size, i, j, filterTaps) < depth ? 0 : 1;
  fetchCount += uint(filterTaps * filterTaps);
  return float(open) / float(filterTaps * filterTaps);
}

// Bias for a window: the receiver's plane leaves its depth by the slope times half the window, not half a texel.
float windowDepth(vec4 receiver, vec2 sizeTexels) {
  const float texel = max(tangentSize.x, tangentSize.y) / float(resolution);
  return receiver.z - bias * receiver.z - boundedSlope(receiver) * texel * (slopeBias + 0.5 * max(sizeTexels.x, sizeTexels.y));
}

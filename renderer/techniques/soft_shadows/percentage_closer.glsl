// SPDX-License-Identifier: BSD-3-Clause
// Percentage-closer filtering: the share of taps, on a regular grid over a window of the map, that do not block.
//
// A window stands for the light as seen through it: tap (i, j) of n x n for the light's point ((i + 1/2) / n, (j + 1/2) / n).
// With the receiver's plane the light behind it is hidden, whatever the map holds: visibility is the exact share of the light's
// rectangle before the plane, times the share of open taps among those whose points lie there. So nothing is hidden twice.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/techniques/soft_shadows/texel_test.glsl"
#include "renderer/techniques/soft_shadows/plane_share.glsl"

layout(binding = kShadowMapUnit) uniform sampler2D shadowMap;
uniform int filterTaps;  // along a side

// Places of tap (i, j) of n x n over a window of `size` texels around `centre`.
vec2 tapPlace(vec2 centre, vec2 size, int i, int j, int n) {
  return centre + size * ((vec2(float(i), float(j)) + 0.5) / float(n) - 0.5);
}

bool isInMap(vec2 at) { return all(greaterThanEqual(at, vec2(0.0))) && all(lessThan(at, vec2(float(resolution)))); }

// Whether the texel at a place blocks, and its depth; outside the map nothing does.
bool tapBlocks(vec2 at, vec4 p, float depth, out float z) {
  z = kEmptyDepth;
  if (!isInMap(at)) return false;
  z = texelFetch(shadowMap, ivec2(at), 0).x;
  return texelBlocks(z, ivec2(at), p, depth);
}

float percentageCloser(vec2 centre, vec2 size, vec4 p, float depth) {
  int open = 0, all = 0;
  float z;
#ifdef BIAS_PLANE
  const bool cut = planeCutsLight(p);
  const vec2 perUnit = receiverPlane * lightSize;
#endif
  for (int j = 0; j < filterTaps; ++j)
    for (int i = 0; i < filterTaps; ++i) {
#ifdef BIAS_PLANE
      if (cut && dot(perUnit, (vec2(float(i), float(j)) + 0.5) / float(filterTaps) - eyeOnLight) >= p.z) continue;
#endif
      ++all;
      open += tapBlocks(tapPlace(centre, size, i, j, filterTaps), p, depth, z) ? 0 : 1;
    }
  fetchCount += uint(all);
  // No tap lies before the plane where less than a tap's share of the light does.
  return shareBeforePlane(p) * (all > 0 ? float(open) / float(all) : 1.0);
}

// Depth that blockers in a window must undercut: by the receiver's slope, its plane leaves its depth by the slope times half
// the window, not half a texel.
float windowDepth(vec4 receiver, vec2 sizeTexels) {
#if defined(BIAS_PLANE) || defined(BIAS_STORED) || defined(BIAS_BY_LEVEL) || defined(BIAS_NORMAL_OFFSET)
  return biasedDepth(receiver, 0);
#else
  const float texel = max(tangentSize.x, tangentSize.y) / float(resolution);
  return receiver.z - bias * receiver.z - boundedSlope(receiver) * texel * (slopeBias + 0.5 * max(sizeTexels.x, sizeTexels.y));
#endif
}

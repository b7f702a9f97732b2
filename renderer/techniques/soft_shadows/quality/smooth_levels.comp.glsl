// SPDX-License-Identifier: BSD-3-Clause
// One axis of the separable filter that smooths the levels of processed pixels. From each pixel it walks both ways and
// stops where the surface ends and where pixels need no processing; in between, weights are Gaussian. Schwarz 2009,
// section 5.2.1, gives the stops and the support; weights and the test for the end of a surface are this bench's.
#include "renderer/techniques/soft_shadows/quality/quality_bindings.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/techniques/soft_shadows/quality/work_list.glsl"

layout(local_size_x = kWorkListGroup) in;
layout(binding = kSplitLevelMapUnit) uniform sampler2D levelMap;  // level (-1: not processed), camera depth
layout(binding = kSmoothLevelsImage, rg32f) uniform writeonly image2D outLevels;

uniform ivec2 sizePx;
uniform ivec2 axis;
uniform int radius;
uniform float sigma;           // pixels
uniform float depthThreshold;  // largest step between neighbours on one surface, as a share of the nearer one's depth

void main() {
  ivec2 pixel;
  if (!listedPixel(pixel)) return;
  const vec2 here = texelFetch(levelMap, pixel, 0).xy;
  float sum = here.x, weights = 1.0;
  for (int side = -1; side <= 1; side += 2) {
    float depth = here.y;
    for (int k = 1; k <= radius; ++k) {
      const ivec2 at = pixel + side * k * axis;
      if (any(lessThan(at, ivec2(0))) || any(greaterThanEqual(at, sizePx))) break;
      const vec2 there = texelFetch(levelMap, at, 0).xy;
      if (there.x < 0.0 || !(abs(there.y - depth) <= depthThreshold * min(there.y, depth))) break;
      const float weight = exp(-0.5 * float(k * k) / (sigma * sigma));
      sum += weight * there.x;
      weights += weight;
      depth = there.y;
    }
  }
  const float level = sum / weights, whole = floor(level + 0.5);
  // The mean of equal whole levels may miss them by rounding, and a second level for nothing would follow.
  imageStore(outLevels, pixel, vec4(abs(level - whole) < 1e-5 ? whole : level, here.y, 0.0, 0.0));
}

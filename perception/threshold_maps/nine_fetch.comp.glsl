// SPDX-License-Identifier: BSD-3-Clause
// One level of the pyramid from the finer one as the thesis does it: 5x5 binomial and bilinear halving at once,
// with nine bilinear fetches. Along each axis pairs (1, 5), (10, 10), (5, 1) of 32. No special treatment of odd
// sizes: there the fetches fall elsewhere between texels and the kernel is another one.
#include "perception/threshold_maps/threshold_map_bindings.h"
#include "perception/threshold_maps/common.glsl"

layout(local_size_x = kThresholdGroupSide, local_size_y = kThresholdGroupSide) in;
layout(binding = kNineFetchSourceUnit) uniform sampler2D source;
#if HALF
layout(binding = kNineFetchCoarserImage, r16f) uniform writeonly image2D coarser;
#else
layout(binding = kNineFetchCoarserImage, r32f) uniform writeonly image2D coarser;
#endif
uniform int sourceLevel;

void main() {
  ivec2 at = ivec2(gl_GlobalInvocationID.xy), size = imageSize(coarser);
  if (any(greaterThanEqual(at, size))) return;
  vec2 step = (5.0 / 3.0) / vec2(textureSize(source, sourceLevel));
  vec2 centre = (vec2(at) + 0.5) / vec2(size);
  const float kWeights[3] = float[3](0.1875, 0.625, 0.1875);
  float sum = 0.0;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i)
      sum += kWeights[i] * kWeights[j] *
             textureLod(source, centre + vec2(i - 1, j - 1) * step, float(sourceLevel)).r;
  imageStore(coarser, at, vec4(sum));
}

// SPDX-License-Identifier: BSD-3-Clause
// Mean luminance of some 4096 pixels on a grid, about which luminance is stored in 16 bits. Any value near the
// image's would do: it is added again.
#include "perception/threshold_maps/threshold_map_bindings.h"
#include "perception/threshold_maps/common.glsl"

layout(local_size_x = kThresholdMeanThreads) in;
layout(binding = kLuminanceSourceUnit) uniform sampler2D source;
layout(std430, binding = kThresholdMeanBuffer) writeonly buffer Mean { float meanLuminance; };
shared float sums[kThresholdMeanThreads];

void main() {
  const int kSide = 64;
  int thread = int(gl_LocalInvocationIndex);
  vec2 size = vec2(textureSize(source, 0));
  float sum = 0.0;
  for (int i = thread; i < kSide * kSide; i += kThresholdMeanThreads) {
    ivec2 at = ivec2((vec2(i % kSide, i / kSide) + 0.5) / float(kSide) * size);
    sum += luminanceOf(texelFetch(source, at, 0));
  }
  sums[thread] = sum;
  barrier();
  for (int count = kThresholdMeanThreads / 2; count > 0; count /= 2) {
    if (thread < count) sums[thread] += sums[thread + count];
    barrier();
  }
  if (thread == 0) meanLuminance = sums[0] / float(kSide * kSide);
}

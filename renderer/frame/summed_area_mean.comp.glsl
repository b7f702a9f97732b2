// SPDX-License-Identifier: BSD-3-Clause
// A constant near the mean of each layer: the mean of 16 x 16 texels spread over it. Any constant serves, since it is
// added again after the look-up; the nearer it is to the mean, the smaller are the sums.
#include "renderer/frame/frame_bindings.h"

const int kSide = 16;
layout(local_size_x = kSide, local_size_y = kSide) in;
layout(binding = kSumsValuesImage, TEXEL) uniform readonly image2DArray values;
layout(std430, binding = kSumsMeansBuffer) writeonly buffer Means { vec2 means[]; };
uniform int resolution;

shared vec2 partial[kSide * kSide];

void main() {
  const int index = int(gl_LocalInvocationIndex), layer = int(gl_WorkGroupID.x);
  const ivec2 at = (2 * ivec2(gl_LocalInvocationID.xy) + 1) * resolution / (2 * kSide);
  partial[index] = imageLoad(values, ivec3(at, layer)).xy;
  for (int step = kSide * kSide / 2; step > 0; step >>= 1) {
    barrier();
    if (index < step) partial[index] += partial[index + step];
  }
  if (index == 0) means[layer] = partial[0] / float(kSide * kSide);
}

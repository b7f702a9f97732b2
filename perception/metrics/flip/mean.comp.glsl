// SPDX-License-Identifier: BSD-3-Clause
// Mean of the map from the groups' sums, in an order that does not vary.
#include "perception/metrics/flip/flip_bindings.h"

layout(local_size_x = kFlipMeanGroup) in;

layout(binding = kFlipGroupSumsBuffer, std430) readonly buffer GroupSums { float groupSums[]; };
layout(binding = kFlipMeanResultBuffer, std430) writeonly buffer Result { float mean; };

uniform uint groupCount;
uniform float pixelCount;

shared float sums[kFlipMeanGroup];

void main() {
  uint index = gl_LocalInvocationIndex;
  float sum = 0.0;
  for (uint group = index; group < groupCount; group += uint(kFlipMeanGroup)) sum += groupSums[group];
  sums[index] = sum;
  for (uint stride = uint(kFlipMeanGroup) / 2u; stride > 0u; stride /= 2u) {
    barrier();
    if (index < stride) sums[index] += sums[index + stride];
  }
  if (index == 0u) mean = sums[0] / pixelCount;
}

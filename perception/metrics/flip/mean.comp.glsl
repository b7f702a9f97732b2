// SPDX-License-Identifier: BSD-3-Clause
// Mean of the map from the groups' sums, in an order that does not vary.

layout(local_size_x = 256) in;

layout(binding = 0, std430) readonly buffer GroupSums { float groupSums[]; };
layout(binding = 1, std430) writeonly buffer Result { float mean; };

uniform uint groupCount;
uniform float pixelCount;

shared float sums[256];

void main() {
  uint index = gl_LocalInvocationIndex;
  float sum = 0.0;
  for (uint group = index; group < groupCount; group += 256u) sum += groupSums[group];
  sums[index] = sum;
  for (uint stride = 128u; stride > 0u; stride /= 2u) {
    barrier();
    if (index < stride) sums[index] += sums[index + stride];
  }
  if (index == 0u) mean = sums[0] / pixelCount;
}

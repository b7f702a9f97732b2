// SPDX-License-Identifier: BSD-3-Clause
// Mean luminance of the coarsest level of both frames, in an order that does not vary.
#include "perception/popping/gpu/popping_bindings.h"

layout(local_size_x = kMeanGroup) in;

layout(binding = kMeanConesUnit) uniform sampler2DArray cones;  // layer: frame
layout(binding = kMeanLuminanceBuffer, std430) writeonly buffer Mean { float meanLuminance[2]; };

uniform int level;
uniform vec3 luminanceOfCones;

shared float sums[kMeanGroup];

void main() {
  int frame = int(gl_WorkGroupID.x);
  ivec2 size = textureSize(cones, level).xy;
  int index = int(gl_LocalInvocationIndex);
  float sum = 0.0;
  for (int i = index; i < size.x * size.y; i += kMeanGroup)
    sum += dot(luminanceOfCones, texelFetch(cones, ivec3(i % size.x, i / size.x, frame), level).xyz);
  sums[index] = sum;
  for (int stride = kMeanGroup / 2; stride > 0; stride /= 2) {
    barrier();
    if (index < stride) sums[index] += sums[index + stride];
  }
  if (index == 0) meanLuminance[frame] = sums[0] / float(size.x * size.y);
}

// SPDX-License-Identifier: BSD-3-Clause
// Mean luminance of the coarsest level of both frames, in an order that does not vary.

layout(local_size_x = 256) in;

layout(binding = 0) uniform sampler2DArray cones;  // layer: frame
layout(binding = 1, std430) writeonly buffer Mean { float meanLuminance[2]; };

uniform int level;
uniform vec3 luminanceOfCones;

shared float sums[256];

void main() {
  int frame = int(gl_WorkGroupID.x);
  ivec2 size = textureSize(cones, level).xy;
  int index = int(gl_LocalInvocationIndex);
  float sum = 0.0;
  for (int i = index; i < size.x * size.y; i += 256)
    sum += dot(luminanceOfCones, texelFetch(cones, ivec3(i % size.x, i / size.x, frame), level).xyz);
  sums[index] = sum;
  for (int stride = 128; stride > 0; stride /= 2) {
    barrier();
    if (index < stride) sums[index] += sums[index + stride];
  }
  if (index == 0) meanLuminance[frame] = sums[0] / float(size.x * size.y);
}

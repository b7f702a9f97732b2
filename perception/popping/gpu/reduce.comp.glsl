// SPDX-License-Identifier: BSD-3-Clause
// The next level of both frames' Gaussian pyramids: five taps along rows, then columns; pixel x of the
// coarser level lies on pixel 2x of the finer.
#include "perception/popping/gpu/popping_bindings.h"

layout(local_size_x = kPoppingGroupX, local_size_y = kPoppingGroupY) in;

layout(binding = kReduceConesUnit) uniform sampler2DArray cones;  // layer: frame
layout(binding = kReduceCoarserImage, rgba32f) uniform writeonly image2DArray coarser;

uniform int level;
uniform vec3 taps;  // outer, inner, centre

const int kRows = 2 * kPoppingGroupY + 3;
shared vec4 rows[kRows * kPoppingGroupX];

void main() {
  int frame = int(gl_WorkGroupID.z);
  ivec2 fineSize = textureSize(cones, level).xy, size = imageSize(coarser).xy;
  ivec2 local = ivec2(gl_LocalInvocationID.xy), pixel = ivec2(gl_GlobalInvocationID.xy);
  int top = 2 * int(gl_WorkGroupID.y) * kPoppingGroupY - 2, centre = 2 * pixel.x;
  for (int row = local.y; row < kRows; row += kPoppingGroupY) {
    int y = clamp(top + row, 0, fineSize.y - 1);
    vec4 tap[5];
    for (int i = 0; i < 5; ++i)
      tap[i] = texelFetch(cones, ivec3(clamp(centre + i - 2, 0, fineSize.x - 1), y, frame), level);
    rows[row * kPoppingGroupX + local.x] = taps.x * (tap[0] + tap[4]) + taps.y * (tap[1] + tap[3]) + taps.z * tap[2];
  }
  barrier();
  if (any(greaterThanEqual(pixel, size))) return;
  int at = 2 * local.y * kPoppingGroupX + local.x;
  vec4 sum = taps.x * (rows[at] + rows[at + 4 * kPoppingGroupX]) + taps.y * (rows[at + kPoppingGroupX] + rows[at + 3 * kPoppingGroupX]) + taps.z * rows[at + 2 * kPoppingGroupX];
  imageStore(coarser, ivec3(pixel, frame), sum);
}

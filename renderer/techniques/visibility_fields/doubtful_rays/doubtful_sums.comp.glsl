// SPDX-License-Identifier: BSD-3-Clause
// Adds what doubtful rays see to what the others do: traced or, if there were more of them than fit into the list, all looked up, so that a
// picture does not depend on the order in which they came. Empties the sums for the next frame.
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kDoubtListBuffer) readonly buffer DoubtList { DoubtListHeader doubtList; };
layout(std430, binding = kDoubtSumsBuffer) buffer DoubtSums { uint doubtSums[]; };
layout(binding = kFieldOutImage, DOUBT_FORMAT) uniform image2D outImage;
uniform ivec2 sizePx;
uniform int rayCount;

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, sizePx))) return;
  const int place = 2 * (pixel.y * sizePx.x + pixel.x);
  const uint traced = doubtSums[place];
  if (traced != 0u) doubtSums[place] = 0u;
  const uint sum = doubtList.overflow != 0u ? doubtSums[place + 1] : traced;
  if (sum == 0u) return;
  const float seen = imageLoad(outImage, pixel).x + float(sum) / (kDoubtUnit * float(rayCount));
  imageStore(outImage, pixel, vec4(vec3((sum & kDoubtCutShort) != 0u ? uintBitsToFloat(0x7fc00000u) : min(seen, 1.0)), 1.0));
}

// SPDX-License-Identifier: BSD-3-Clause
// Gives all pixels of a block the most samples that one of them asks for (Holländer 2013, section 4.3.5).
#include "renderer/techniques/antialiasing/antialiasing_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(binding = kSampleCountsUnit) uniform usampler2D counts;
layout(binding = kSampleCountsImage, r32ui) uniform writeonly uimage2D outCounts;
uniform ivec2 pictureSizePx;
uniform int block;  // px a side

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, pictureSizePx))) return;
  const ivec2 first = pixel / block * block, end = min(first + block, pictureSizePx);
  uint most = 1u;
  for (int y = first.y; y < end.y; ++y)
    for (int x = first.x; x < end.x; ++x) most = max(most, texelFetch(counts, ivec2(x, y), 0).x);
  imageStore(outCounts, pixel, uvec4(most, 0u, 0u, 0u));
}

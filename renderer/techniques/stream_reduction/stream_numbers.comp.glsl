// SPDX-License-Identifier: BSD-3-Clause
// The numbers of a stream's items, row by row. LANES: words of an item, 1 or 2.
#include "renderer/techniques/stream_reduction/stream_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
layout(std430, binding = kStreamItemsBuffer) readonly buffer Items { uint words[]; };
layout(std430, binding = kStreamCountBuffer) readonly buffer Count { uint counts[]; };
layout(binding = kStreamImage, r32f) writeonly uniform image2D product;

uniform ivec2 sizePx;
uniform uint countAt;  // word that holds the number of items
uniform uint room;     // items that the buffer holds

void main() {
  const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(texel, sizePx))) return;
  const uint i = uint(texel.y * sizePx.x + texel.x);
  float value = -1.0;
  if (i < min(counts[countAt], room)) {
    const uint number = words[i * uint(LANES)];
    // Larger numbers are no item's: 2^24 is what floats still hold.
    value = float(min(number, 1u << 24));
#if LANES == 2
    // Words that do not belong together are no item either.
    if ((words[i * 2u + 1u] ^ number) != kPairBits) value = float(1u << 24);
#endif
  }
  imageStore(product, texel, vec4(value));
}

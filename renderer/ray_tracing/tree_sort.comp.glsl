// SPDX-License-Identifier: BSD-3-Clause
// One pass of a stable radix sort by 8 bits of the keys. COUNT: how often each digit occurs in each group's items; else
// the items move to where the sums of these counts say (Merrill and Grimshaw 2010). Within a group an item's place among
// those of its digit is counted from masks of 32 items.
#include "renderer/ray_tracing/rebuilt_tree_bindings.h"

layout(local_size_x = kTreeGroup) in;
layout(std430, binding = kTreeKeysBuffer) readonly buffer Keys { uvec2 keys[]; };
#ifdef COUNT
layout(std430, binding = kTreeCountsBuffer) writeonly buffer Counts { uint counts[]; };  // digit by digit
#else
layout(std430, binding = kTreeOrderBuffer) readonly buffer Order { uint order[]; };
layout(std430, binding = kTreeKeysOutBuffer) writeonly buffer KeysOut { uvec2 keysOut[]; };
layout(std430, binding = kTreeOrderOutBuffer) writeonly buffer OrderOut { uint orderOut[]; };
layout(std430, binding = kTreeCountsBuffer) readonly buffer Counts { uint counts[]; };  // sums
#endif

uniform uint triangleCount, tileCount, shift;

uint digitOf(uvec2 key) { return ((shift < 32u ? key.x : key.y) >> (shift & 31u)) & 255u; }

#ifdef COUNT
shared uint histogram[kTreeDigits];
#else
const uint kMasks = uint(kTreeGroup) / 32u;
shared uint masks[kTreeDigits][kMasks];
shared uint before[kTreeDigits][kMasks];
shared uint next[kTreeDigits];
#endif

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (tile >= tileCount) return;
  const uint first = tile * uint(kTreeGroup * kTreeSortRounds);
#ifdef COUNT
  histogram[me] = 0u;
  barrier();
  for (int round = 0; round < kTreeSortRounds; ++round) {
    const uint at = first + uint(round * kTreeGroup) + me;
    if (at < triangleCount) atomicAdd(histogram[digitOf(keys[at])], 1u);
  }
  barrier();
  counts[me * tileCount + tile] = histogram[me];
#else
  // As many digits as invocations.
  next[me] = counts[me * tileCount + tile];
  for (int round = 0; round < kTreeSortRounds; ++round) {
    for (uint i = 0u; i < kMasks; ++i) masks[me][i] = 0u;
    barrier();
    const uint at = first + uint(round * kTreeGroup) + me;
    const bool some = at < triangleCount;
    uvec2 key = uvec2(0u);
    uint digit = 0u;
    if (some) {
      key = keys[at];
      digit = digitOf(key);
      atomicOr(masks[digit][me / 32u], 1u << (me % 32u));
    }
    barrier();
    uint sum = next[me];
    for (uint i = 0u; i < kMasks; ++i) {
      before[me][i] = sum;
      sum += uint(bitCount(masks[me][i]));
    }
    next[me] = sum;
    barrier();
    if (some) {
      const uint place =
          before[digit][me / 32u] + uint(bitCount(masks[digit][me / 32u] & ((1u << (me % 32u)) - 1u)));
      keysOut[place] = key;
      orderOut[place] = order[at];
    }
    barrier();
  }
#endif
}

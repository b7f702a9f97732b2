// SPDX-License-Identifier: BSD-3-Clause
// Stream reduction with an invocation for each block of BLOCK items. One of COUNT, SCATTER.
#include "renderer/compute/reduction_items.glsl"
#include "renderer/compute/reduction_single_items.glsl"

layout(local_size_x = kBlockGroup) in;

// COUNT: valid items of each block; SCATTER: of all blocks before it, and then of all.
layout(std430, binding = kReductionSumsBuffer) buffer Sums { uint sums[]; };

uniform uint blocks;

void main() {
  const uint block = groupNumber() * uint(kBlockGroup) + gl_LocalInvocationIndex;
  if (block >= blocks) return;
  const uint count = itemCount();
#ifdef COUNT
  uint valid = 0u;
  for (uint i = 0u; i < uint(BLOCK); ++i)
    if (isValid(block * uint(BLOCK) + i, count)) ++valid;
  sums[block] = valid;
#else
  if (block == 0u) finishCount(sums[blocks]);
  uint slot = sums[block];
  for (uint i = 0u; i < uint(BLOCK); ++i) {
    const uint at = block * uint(BLOCK) + i;
    if (isValid(at, count)) put(slot++, items[at]);
  }
#endif
}

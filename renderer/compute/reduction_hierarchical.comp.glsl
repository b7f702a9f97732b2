// SPDX-License-Identifier: BSD-3-Clause
// Hierarchical stream reduction (Roger 2008, section 4.3) with blocks of BLOCK items. One of REDUCE (within blocks), JOIN, FINISH.
// BLELLOCH: how blocks are summed.
#include "renderer/compute/reduction_items.glsl"
#include "renderer/compute/reduction_single_items.glsl"

const int kGroup = BLOCK < kBlockGroup ? kBlockGroup : BLOCK;
layout(local_size_x = kGroup) in;

uniform uint blocks;

#ifdef REDUCE
layout(std430, binding = kReductionStateBuffer) writeonly buffer Gathered { ITEM gathered[]; };
layout(std430, binding = kReductionSumsBuffer) writeonly buffer Invalid { uint invalid[]; };
#ifdef COUNT_FETCHES
layout(std430, binding = kReductionFetchesBuffer) buffer Fetches { uint fetches; };
#endif
shared ITEM blockItems[kGroup];
shared uint sums[kGroup];  // within each block, inclusive
uint blockStart() { return gl_LocalInvocationIndex / uint(BLOCK) * uint(BLOCK); }

uint invalidUpTo(uint j) { return sums[blockStart() + j]; }
bool isInvalid(uint j) { return sums[blockStart() + j] != (j == 0u ? 0u : sums[blockStart() + j - 1u]); }
#include "renderer/compute/item_search.glsl"

void scanBlocks(uint own) {
  const uint me = gl_LocalInvocationIndex, local = me % uint(BLOCK);
  sums[me] = own;
  barrier();
#ifdef BLELLOCH
  for (uint distance_ = 1u; distance_ < uint(BLOCK); distance_ *= 2u) {
    if ((local + 1u) % (2u * distance_) == 0u) sums[me] += sums[me - distance_];
    barrier();
  }
  if (local == uint(BLOCK) - 1u) sums[me] = 0u;
  barrier();
  for (uint distance_ = uint(BLOCK) / 2u; distance_ > 0u; distance_ /= 2u) {
    if ((local + 1u) % (2u * distance_) == 0u) {
      const uint left = sums[me - distance_];
      sums[me - distance_] = sums[me];
      sums[me] += left;
    }
    barrier();
  }
  // From exclusive to inclusive.
  sums[me] += own;
  barrier();
#else
  for (uint distance_ = 1u; distance_ < uint(BLOCK); distance_ *= 2u) {
    const uint left = local >= distance_ ? sums[me - distance_] : 0u;
    barrier();
    sums[me] += left;
    barrier();
  }
#endif
}

void main() {
  const uint me = gl_LocalInvocationIndex, local = me % uint(BLOCK);
  const uint at = groupNumber() * uint(kGroup) + me;
  const bool valid = isValid(at, itemCount());
  if (valid) blockItems[me] = items[at];
  scanBlocks(valid ? 0u : 1u);
  const uint block = at / uint(BLOCK);
  if (block >= blocks) return;
  if (local == uint(BLOCK) - 1u) invalid[block] = sums[me];
  const uint found = findItem(local, uint(BLOCK));
  if (found < uint(BLOCK)) gathered[at] = blockItems[blockStart() + found];
#ifdef COUNT_FETCHES
  atomicAdd(fetches, searchFetches);
#endif
}
#else
layout(std430, binding = kReductionStateBuffer) readonly buffer Gathered { ITEM gathered[]; };
layout(std430, binding = kReductionSumsBuffer) readonly buffer Sums { uint sums[]; };  // exclusive, over blocks

void main() {
  const uint at = groupNumber() * uint(kGroup) + gl_LocalInvocationIndex;
  if (at == 0u) finishCount(blocks * uint(BLOCK) - sums[blocks]);
#ifdef JOIN
  const uint block = at / uint(BLOCK);
  if (block >= blocks) return;
  const uint shift = sums[block];
  const uint valid = uint(BLOCK) - (sums[block + 1u] - shift);
  if (at % uint(BLOCK) < valid) put(at - shift, gathered[at]);
#endif
}
#endif

// SPDX-License-Identifier: BSD-3-Clause
// Distribution to BUCKETS buckets. See bucket_sort.h. One of COUNT, SCATTER.
#include "renderer/compute/reduction_bindings.h"

layout(local_size_x = kReductionGroup) in;

layout(std430, binding = kReductionItemsBuffer) readonly buffer Items { uint items[]; };
layout(std430, binding = kReductionFlagsBuffer) readonly buffer Keys { uint keys[]; };
layout(std430, binding = kReductionOutBuffer) writeonly buffer Out { uint sorted_[]; };
// Bucket by bucket and within each tile by tile: counts, then what lies before.
layout(std430, binding = kReductionStateBuffer) buffer Table { uint table[]; };
layout(std430, binding = kReductionCountBuffer) writeonly buffer Starts { uint starts[]; };

uniform uint count, tiles;

const uint kTile = uint(kReductionGroup * kReductionRows);
const uint kBuckets = uint(BUCKETS);
const int kWords = (BUCKETS + 1) / 2;  // two buckets' counts in each: a row has 256 items

// kBuckets from `count` on and for what is invalid.
uint bucketOf(uint i) {
  if (i >= count || items[i] == kInvalidItem) return kBuckets;
  return min(keys[i], kBuckets);
}

#ifdef COUNT
shared uint counts[BUCKETS];
#else
shared uint sums[2][kWords][kReductionGroup];
#endif

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  if (tile >= tiles) return;
#ifdef COUNT
  if (me < kBuckets) counts[me] = 0u;
  barrier();
  for (uint row = 0u; row < uint(kReductionRows); ++row) {
    const uint bucket = bucketOf(tile * kTile + row * uint(kReductionGroup) + me);
    if (bucket < kBuckets) atomicAdd(counts[bucket], 1u);
  }
  barrier();
  if (me < kBuckets) table[me * tiles + tile] = counts[me];
#else
  if (tile == 0u && me <= kBuckets) starts[me] = table[me * tiles];
  uint before[BUCKETS];
  for (uint bucket = 0u; bucket < kBuckets; ++bucket) before[bucket] = table[bucket * tiles + tile];
  for (uint row = 0u; row < uint(kReductionRows); ++row) {
    const uint at = tile * kTile + row * uint(kReductionGroup) + me;
    const uint bucket = bucketOf(at);
    for (int word = 0; word < kWords; ++word)
      sums[0][word][me] = bucket / 2u == uint(word) ? 1u << (bucket % 2u * 16u) : 0u;
    barrier();
    // Inclusive sums of all buckets at once, left in sums[0] since log2 of the group's 256 invocations is even.
    int from = 0;
    for (uint distance_ = 1u; distance_ < uint(kReductionGroup); distance_ *= 2u) {
      for (int word = 0; word < kWords; ++word) {
        uint sum = sums[from][word][me];
        if (me >= distance_) sum += sums[from][word][me - distance_];
        sums[1 - from][word][me] = sum;
      }
      from = 1 - from;
      barrier();
    }
    if (bucket < kBuckets)
      sorted_[before[bucket] + (sums[0][bucket / 2u][me] >> (bucket % 2u * 16u) & 0xffffu) - 1u] = items[at];
    for (uint other = 0u; other < kBuckets; ++other)
      before[other] += sums[0][other / 2u][kReductionGroup - 1] >> (other % 2u * 16u) & 0xffffu;
    barrier();
  }
#endif
}

// SPDX-License-Identifier: BSD-3-Clause
// Stream reduction by a scan of the whole stream and a search in it. See stream_reduction.h. One of MARK, SEARCH.
#include "renderer/compute/reduction_items.glsl"
#include "renderer/compute/reduction_single_items.glsl"

layout(local_size_x = kBlockGroup) in;

layout(std430, binding = kReductionSumsBuffer) buffer Sums { uint sums[]; };
#ifdef COUNT_FETCHES
layout(std430, binding = kReductionFetchesBuffer) buffer Fetches { uint fetches; };
#endif

#ifdef SEARCH
uint invalidUpTo(uint j) { return sums[j]; }
bool isInvalid(uint j) { return !isValid(j, itemCount()); }
#include "renderer/compute/item_search.glsl"
#endif

void main() {
  const uint i = groupNumber() * uint(kBlockGroup) + gl_LocalInvocationIndex;
  const uint count = itemCount();
#ifdef MARK
  if (i < most) sums[i] = isValid(i, count) ? 0u : 1u;
#else
  // Items from `count` on are marked invalid.
  if (i == 0u) finishCount(most == 0u ? 0u : most - sums[most - 1u]);
  if (i >= min(count, capacity)) return;
  const uint found = findItem(i, most);
  if (found < most) put(i, items[found]);
#ifdef COUNT_FETCHES
  atomicAdd(fetches, searchFetches);
#endif
#endif
}

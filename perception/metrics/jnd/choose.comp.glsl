// SPDX-License-Identifier: BSD-3-Clause
// Finds, for each rank, the bin of the histogram that holds it; empties the histogram for the next round. In the last
// round also the highest rating of the regions. One work group.
#include "perception/metrics/jnd/statistics.glsl"
#include "perception/popping/gpu/popping_bindings.h"

layout(local_size_x = kChooseGroup) in;
layout(binding = kJndRegionsBuffer, std430) readonly buffer Table {
  RegionTableHeader table;
  RegionRecord regions[];
};
uniform float ratingWithoutRegion;

shared uint sums[kChooseGroup];
shared float ratings[kChooseGroup];

// Nearest rank, from 1: the smallest value that at least this share of them do not exceed.
uint firstRank(int rank, uint count) { return rank == 0 ? (count + 1u) / 2u : (19u * count + 19u) / 20u; }

void main() {
  const uint self = gl_LocalInvocationIndex;
  const uint count = statistics.evaluatedPx;
  const int binsOfRank = round_ == 0 ? kJndBins : kJndBins / kJndRanks;
  const uint chunk = uint(binsOfRank / kChooseGroup);
  const uint shift = round_ == 0 ? 20u : round_ == 1 ? 10u : 0u;
  for (int rank = 0; rank < kJndRanks; ++rank) {
    const uint start = round_ == 0 ? 0u : uint(rank * binsOfRank);
    const uint wanted = round_ == 0 ? firstRank(rank, count) : statistics.rank[rank];
    uint own = 0u;
    for (uint i = 0u; i < chunk; ++i) own += histogram[start + self * chunk + i];
    sums[self] = own;
    barrier();
    for (uint reach = 1u; reach < uint(kChooseGroup); reach *= 2u) {
      const uint before = self >= reach ? sums[self - reach] : 0u;
      barrier();
      sums[self] += before;
      barrier();
    }
    uint below = sums[self] - own;
    if (wanted > below && wanted <= sums[self]) {  // one invocation, or none if nothing was counted
      uint bin = self * chunk;
      while (wanted > below + histogram[start + bin]) below += histogram[start + bin++];
      statistics.valueBits[rank] |= bin << shift;
      statistics.rank[rank] = wanted - below;
    }
    barrier();
  }
  memoryBarrierBuffer();
  barrier();
  for (uint bin = self; bin < uint(kJndBins); bin += uint(kChooseGroup)) histogram[bin] = 0u;
  if (round_ != 2) return;
  float highest = ratingWithoutRegion;
  for (uint region = self; region < table.regionCount; region += uint(kChooseGroup))
    highest = max(highest, regions[region].rating);
  ratings[self] = highest;
  for (uint stride = uint(kChooseGroup) / 2u; stride > 0u; stride /= 2u) {
    barrier();
    if (self < stride) ratings[self] = max(ratings[self], ratings[self + stride]);
  }
  if (self == 0u) {
    statistics.rating = ratings[0];
    statistics.regionCount = table.regionCount;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// Valid items of all tiles before one, from what these have left in `state` (Merrill and Garland 2016). After reduction_tile.glsl.

layout(std430, binding = kReductionStateBuffer) coherent volatile buffer State { uint state[]; };
layout(std430, binding = kReductionStateBuffer) coherent volatile readonly buffer States { uvec4 fourStates[]; };

uniform uint tilesAt, clearedAt, tilesAtMost;  // states of this dispatch and of the next

const int kSpins = 4096;  // of an invocation in all: none follow where groups run in another order
const uint kNoDistance = 0xffffffffu;

#ifdef SUBGROUPS
const int kLookVectors = LOOKS;  // each invocation's, of four states: looked at together

// The four states from the tile 4 `vector` on; of what is not before `end`: none.
uvec4 statesAt(int vector, int end) {
  if (vector < 0) return uvec4(kReductionOwn);
  const uvec4 found = fourStates[tilesAt / 4u + uint(vector)];
  return mix(uvec4(kReductionOwn), found, lessThan(ivec4(4 * vector) + ivec4(0, 1, 2, 3), ivec4(end)));
}

// Valid items of all tiles before `tile`; called by one subgroup.
uint countBefore(uint tile, uint count) {
  const int lane = int(ownLane());
  uint sum = 0u;
  int end = int(tile), spins = kSpins;
  while (end > 0) {
    const int nearest = (end - 1) / 4 - lane;  // the invocation's vector of four
    uvec4 theirs[kLookVectors];
    for (int i = 0; i < kLookVectors; ++i) theirs[i] = statesAt(nearest - 32 * i, end);
    // The nearest tile that has a sum of all, 2 d + 1 for its distance d, or that nobody has counted, 2 d.
    uint stop;
    while (true) {
      stop = kNoDistance;
      for (int i = kLookVectors - 1; i >= 0; --i)
        for (int k = 0; k < 4; ++k) {
          const uint distance_ = uint(end - 1 - 4 * (nearest - 32 * i) - k);
          if (theirs[i][k] == kReductionNothing) stop = 2u * distance_;
          if (theirs[i][k] >= kReductionAll) stop = 2u * distance_ + 1u;
        }
      stop = subgroupMin(stop);
      if ((stop & 1u) != 0u || spins-- <= 0) break;
      for (int i = 0; i < kLookVectors; ++i)
        if (any(equal(theirs[i], uvec4(kReductionNothing)))) theirs[i] = statesAt(nearest - 32 * i, end);
    }
    const bool all = stop != kNoDistance && (stop & 1u) != 0u, missing = (stop & 1u) == 0u;
    // Tiles up to a sum of all or before one that is missing.
    const int farthest = stop == kNoDistance ? end : all ? int(stop / 2u) : int(stop / 2u) - 1;
    uint own = 0u;
    for (int i = 0; i < kLookVectors; ++i)
      for (int k = 0; k < 4; ++k)
        if (end - 1 - 4 * (nearest - 32 * i) - k <= farthest) own += theirs[i][k] & kReductionCountMask;
    sum += subgroupAdd(own);
    if (all) break;
    if (!missing) {
      end = 4 * ((end - 1) / 4 + 1 - 32 * kLookVectors);
      continue;
    }
    // Whoever holds that tile may never run on while this group waits: its tile is added up here.
    end -= int(stop / 2u) + 1;
    spins = 0;
    uint valid = 0u;
    for (uint row = 0u; row < uint(ROWS); ++row)
      for (uint place = uint(lane); place < uint(GROUP); place += 32u)
        valid += bitCount(pieceAt(uint(end), row, place, count).valid);
    sum += subgroupAdd(valid);
  }
  return sum;
}
#else
const int kLooks = 4;  // tiles that each invocation of a group looks back at together

shared uint groupWord;
// Distances of the nearest tile whose sum includes all before it, and of the nearest that nobody has counted.
shared uint nearestAll, nearestNothing;

uint sumOfGroup(uint own) {
  atomicAdd(groupWord, own);
  barrier();
  return groupWord;
}

// Valid items of all tiles before `tile`; called by the whole group.
uint countBefore(uint tile, uint count) {
  const uint me = gl_LocalInvocationIndex;
  uint sum = 0u;
  int end = int(tile), spins = kSpins;
  while (end > 0) {
    if (me == 0u) {
      nearestAll = kNoDistance;
      nearestNothing = kNoDistance;
      groupWord = 0u;
    }
    barrier();
    uint theirs[kLooks];
    for (int i = 0; i < kLooks; ++i) {
      const int other = end - 1 - int(me) - i * GROUP;
      theirs[i] = other < 0 ? kReductionOwn : state[tilesAt + uint(other)];
    }
    uint all = kNoDistance, nothing = kNoDistance;
    for (int i = kLooks - 1; i >= 0; --i) {
      const int other = end - 1 - int(me) - i * GROUP;
      for (; spins > 0 && theirs[i] == kReductionNothing; --spins) theirs[i] = state[tilesAt + uint(other)];
      const uint distance_ = me + uint(i * GROUP);
      if (theirs[i] == kReductionNothing) nothing = distance_;
      if (theirs[i] >= kReductionAll) all = distance_;
    }
    if (all != kNoDistance) atomicMin(nearestAll, all);
    if (nothing != kNoDistance) atomicMin(nearestNothing, nothing);
    barrier();
    const uint farthestTaken = min(nearestAll, nearestNothing - 1u);  // before any: all
    uint own = 0u;
    for (int i = 0; i < kLooks; ++i)
      if (nearestNothing != 0u && me + uint(i * GROUP) <= farthestTaken) own += theirs[i] & kReductionCountMask;
    sum += sumOfGroup(own);
    const bool done = nearestAll < nearestNothing;
    const uint missing = nearestNothing;
    barrier();
    if (done) break;
    if (missing == kNoDistance) {
      end -= kLooks * GROUP;
      continue;
    }
    // Whoever holds that tile may never run on while this group waits: its tile is added up here.
    end -= int(missing) + 1;
    if (me == 0u) groupWord = 0u;
    barrier();
    uint valid = 0u;
    for (int row = 0; row < ROWS; ++row) valid += bitCount(pieceAt(uint(end), uint(row), ownPlace(), count).valid);
    sum += sumOfGroup(valid);
    barrier();
  }
  return sum;
}
#endif

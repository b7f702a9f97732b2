// SPDX-License-Identifier: BSD-3-Clause
// Exclusive prefix sums. See prefix_sum.h. LANES: numbers of an element. One of LOOK_BACK, REDUCE, TILES, SCAN,
// and ALONE: all elements are in one tile.
#include "renderer/compute/compute_bindings.h"

layout(local_size_x = kScanGroup) in;

#if LANES == 1
#define ELEMENT uint
#else
#define ELEMENT uvec2
#endif

const uint kPerVector = 4u / uint(LANES);                  // elements in 16 bytes
const uint kPerRow = uint(kScanGroup) * kPerVector;
const uint kPerTile = uint(kScanRows) * kPerRow;

layout(std430, binding = kScanValuesBuffer) readonly buffer Values { uvec4 values[]; };
layout(std430, binding = kScanSumsBuffer) writeonly buffer Sums { uvec4 sums[]; };
#ifdef LOOK_BACK
// Of each tile its own sum, then the sum of all up to it.
layout(std430, binding = kScanTilesBuffer) coherent volatile buffer Tiles { ELEMENT tileSums[]; };
layout(std430, binding = kScanStateBuffer) coherent volatile buffer State { uint tileState[]; };
// Dispatches take turns with two sets of states: each clears the other one's.
uniform uint statesAt, clearedAt, statesAtMost;
#else
layout(std430, binding = kScanTilesBuffer) buffer Tiles { ELEMENT tileSums[]; };
#endif

uniform uint count, tileCount;

uint added(uint a, uint b) {
  const uint sum = a + b;
  return sum < a ? 0xffffffffu : sum;
}
uvec2 added(uvec2 a, uvec2 b) { return uvec2(added(a.x, b.x), added(a.y, b.y)); }

// The elements of row `row` that this invocation holds, 0 from `count` on.
uvec4 valuesAt(uint tile, uint row) {
  const uint first = tile * kPerTile + row * kPerRow + gl_LocalInvocationIndex * kPerVector;
  if (first >= count) return uvec4(0u);
  uvec4 found = values[first / kPerVector];
#if LANES == 1
  if (first + 1u >= count) found.y = 0u;
  if (first + 2u >= count) found.z = 0u;
  if (first + 3u >= count) found.w = 0u;
#else
  if (first + 1u >= count) found.zw = uvec2(0u);
#endif
  return found;
}

ELEMENT sumOf(uvec4 vector) {
#if LANES == 1
  return added(added(vector.x, vector.y), added(vector.z, vector.w));
#else
  return added(vector.xy, vector.zw);
#endif
}

shared ELEMENT line[kScanGroup];

// Sum over the group; to all of it.
ELEMENT groupSum(ELEMENT value) {
  const uint me = gl_LocalInvocationIndex;
  barrier();
  line[me] = value;
  barrier();
  for (uint half_ = uint(kScanGroup) / 2u; half_ > 0u; half_ /= 2u) {
    if (me < half_) line[me] = added(line[me], line[me + half_]);
    barrier();
  }
  return line[0];
}

ELEMENT tileSum(uint tile) {
  ELEMENT sum = ELEMENT(0u);
  for (uint row = 0u; row < uint(kScanRows); ++row) sum = added(sum, sumOf(valuesAt(tile, row)));
  return groupSum(sum);
}

#if defined(LOOK_BACK) || defined(SCAN) || defined(ALONE)
shared ELEMENT rows[2][kScanRows][kScanGroup];

// Inclusive sums along the rows, each its own.
void scanRows(in ELEMENT value[kScanRows]) {
  const uint me = gl_LocalInvocationIndex;
  for (int row = 0; row < kScanRows; ++row) rows[0][row][me] = value[row];
  barrier();
  uint from = 0u;
  for (uint step_ = 1u; step_ < uint(kScanGroup); step_ *= 2u) {
    for (int row = 0; row < kScanRows; ++row) {
      ELEMENT sum = rows[from][row][me];
      if (me >= step_) sum = added(rows[from][row][me - step_], sum);
      rows[1u - from][row][me] = sum;
    }
    from = 1u - from;
    barrier();
  }
}
// log2 of the group's 256 invocations is even: the results are in rows[0].

void store(uint tile, uint row, uvec4 own, ELEMENT before) {
  const uint first = tile * kPerTile + row * kPerRow + gl_LocalInvocationIndex * kPerVector;
  if (first > count) return;
#if LANES == 1
  uvec4 result;
  result.x = before;
  result.y = added(result.x, own.x);
  result.z = added(result.y, own.y);
  result.w = added(result.z, own.z);
#else
  const uvec4 result = uvec4(before, added(before, own.xy));
#endif
  sums[first / kPerVector] = result;
}
#endif

#ifdef LOOK_BACK
shared uint windowState[kScanWindow];
shared ELEMENT windowSums[kScanWindow];
const int kSpins = 4096;  // of an invocation in all: none follow where groups run in another order

// Sum of all tiles before `tile`; called by the whole group.
ELEMENT sumBefore(uint tile) {
  const uint me = gl_LocalInvocationIndex;
  ELEMENT sum = ELEMENT(0u);
  int end = int(tile), spins = kSpins;
  while (end > 0) {
    if (me < uint(kScanWindow)) {
      const int other = end - 1 - int(me);
      uint state = kScanTileAll;
      ELEMENT theirs = ELEMENT(0u);
      if (other >= 0) {
        state = kScanTileNothing;
        for (; spins > 0 && state == kScanTileNothing; --spins) state = tileState[statesAt + uint(other)];
        memoryBarrierBuffer();
        if (state != kScanTileNothing) theirs = tileSums[2 * other + (state == kScanTileAll ? 1 : 0)];
      }
      windowState[me] = state;
      windowSums[me] = theirs;
    }
    barrier();
    int taken = 0;
    bool done = false;
    while (taken < kScanWindow && !done && windowState[taken] != kScanTileNothing) {
      sum = added(windowSums[taken], sum);
      done = windowState[taken] == kScanTileAll;
      ++taken;
    }
    if (done) break;
    end -= taken;
    // Whoever holds that tile may never run on while this group waits: its tile is added up here.
    if (taken < kScanWindow) {
      sum = added(tileSum(uint(end - 1)), sum);
      --end;
    }
    barrier();
  }
  return sum;
}
#endif

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
#ifdef LOOK_BACK
  for (uint i = tile * uint(kScanGroup) + me; i < statesAtMost; i += gl_NumWorkGroups.x * gl_NumWorkGroups.y * uint(kScanGroup))
    tileState[clearedAt + i] = kScanTileNothing;
#endif
  if (tile >= tileCount) return;

#ifdef REDUCE
  const ELEMENT sum = tileSum(tile);
  if (me == 0u) tileSums[tile] = sum;
#elif defined(TILES)
  // One group: exclusive sums in place, a group's width at a time.
  ELEMENT before = ELEMENT(0u);
  for (uint first = 0u; first < tileCount; first += uint(kScanGroup)) {
    const uint at = first + me;
    const ELEMENT own = at < tileCount ? tileSums[at] : ELEMENT(0u);
    barrier();
    line[me] = own;
    barrier();
    for (uint step_ = 1u; step_ < uint(kScanGroup); step_ *= 2u) {
      ELEMENT sum = line[me];
      if (me >= step_) sum = added(line[me - step_], sum);
      barrier();
      line[me] = sum;
      barrier();
    }
    if (at < tileCount) tileSums[at] = me == 0u ? before : added(before, line[me - 1u]);
    before = added(before, line[kScanGroup - 1]);
  }
#else
  uvec4 own[kScanRows];
  ELEMENT sums_[kScanRows];
  for (int row = 0; row < kScanRows; ++row) {
    own[row] = valuesAt(tile, uint(row));
    sums_[row] = sumOf(own[row]);
  }
  scanRows(sums_);
#ifdef LOOK_BACK
  ELEMENT whole = rows[0][0][kScanGroup - 1];
  for (int row = 1; row < kScanRows; ++row) whole = added(whole, rows[0][row][kScanGroup - 1]);
  if (me == 0u) {
    tileSums[2u * tile + (tile == 0u ? 1u : 0u)] = whole;
    memoryBarrierBuffer();
    tileState[statesAt + tile] = tile == 0u ? kScanTileAll : kScanTileOwn;
  }
  ELEMENT before = ELEMENT(0u);
  if (tile > 0u) {
    before = sumBefore(tile);
    if (me == 0u) {
      tileSums[2u * tile + 1u] = added(before, whole);
      memoryBarrierBuffer();
      tileState[statesAt + tile] = kScanTileAll;
    }
  }
#elif defined(ALONE)
  ELEMENT before = ELEMENT(0u);
#else
  ELEMENT before = tileSums[tile];
#endif
  for (int row = 0; row < kScanRows; ++row) {
    store(tile, uint(row), own[row], me == 0u ? before : added(before, rows[0][row][me - 1u]));
    before = added(before, rows[0][row][kScanGroup - 1]);
  }
#endif
}

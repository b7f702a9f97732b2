// SPDX-License-Identifier: BSD-3-Clause
// Stream reduction by scan and scatter. See stream_reduction.h. One of LOOK_BACK, COUNT, TILES, SCATTER, APPEND. SCATTER: each group
// adds up the counts of the tiles before its own with ADD_UP, and has their sum from TILES without.
#ifdef SUBGROUPS
#include "renderer/compute/subgroup_of_32.glsl"
#endif
#include "renderer/compute/reduction_items.glsl"

layout(local_size_x = GROUP) in;

#include "renderer/compute/reduction_tile.glsl"

#ifdef LOOK_BACK
#include "renderer/compute/reduction_look_back.glsl"
#else
layout(std430, binding = kReductionStateBuffer) buffer State { uint state[]; };
#endif

shared uint sharedWord;

#ifdef APPEND
// The last group leaves the state as it found it.
void finishGroup() {
  const uint me = gl_LocalInvocationIndex;
  barrier();
  if (me == 0u) {
    memoryBarrierBuffer();
    sharedWord = atomicAdd(state[kReductionFinished], 1u);
  }
  barrier();
  if (sharedWord + 1u < gl_NumWorkGroups.x * gl_NumWorkGroups.y) return;
  if (me == 0u) finishCount(atomicAdd(state[kReductionTotal], 0u));
  barrier();
  if (me < kReductionTiles) state[me] = 0u;
}

void appendTile(uint tile, uint count, uint tileCount) {
  if (tile < tileCount) {
    Piece pieces[ROWS];
    readTile(tile, count, pieces);
    const TileSlots slots = tileSlots(pieces);
    if (gl_LocalInvocationIndex == 0u) sharedWord = atomicAdd(state[kReductionTotal], slots.whole);
    packTile(pieces, slots);
    barrier();
    writeTile(pieces, slots, sharedWord);
  }
  finishGroup();
}
#endif

#ifdef LOOK_BACK
void lookBackTile(uint tile, uint count, uint tileCount) {
  const uint me = gl_LocalInvocationIndex;
  Piece pieces[ROWS];
  readTile(tile, count, pieces);
  const TileSlots slots = tileSlots(pieces);
  if (me == 0u) state[tilesAt + tile] = slots.whole | (tile == 0u ? kReductionAll : kReductionOwn);
#ifdef SUBGROUPS
  if (ownSubgroup() == 0u) {
    const uint found = countBefore(tile, count);
    if (ownLane() == 0u) {
      sharedWord = found;
      if (tile > 0u) state[tilesAt + tile] = (found + slots.whole) | kReductionAll;
      if (tile + 1u == tileCount) finishCount(found + slots.whole);
    }
  }
  packTile(pieces, slots);
  barrier();
  const uint before = sharedWord;
#else
  packTile(pieces, slots);
  const uint before = countBefore(tile, count);
  if (me == 0u && tile > 0u) state[tilesAt + tile] = (before + slots.whole) | kReductionAll;
  if (me == 0u && tile + 1u == tileCount) finishCount(before + slots.whole);
  barrier();
#endif
  writeTile(pieces, slots, before);
}
#endif

#ifdef COUNT
void countTile(uint tile, uint count) {
  uint own = 0u;
  for (uint row = 0u; row < uint(ROWS); ++row) own += bitCount(pieceAt(tile, row, ownPlace(), count).valid);
  if (gl_LocalInvocationIndex == 0u) sharedWord = 0u;
  barrier();
#ifdef SUBGROUPS
  own = subgroupAdd(own);
  if (ownLane() == 0u)
#endif
    atomicAdd(sharedWord, own);
  barrier();
  if (gl_LocalInvocationIndex == 0u) state[kReductionTiles + tile] = sharedWord;
}
#endif

#ifdef TILES
// One group: exclusive sums in place, an invocation for as many tiles as each has.
shared uint tileSums[GROUP];

void sumTiles(uint tileCount) {
  const uint me = gl_LocalInvocationIndex;
  const uint each = (tileCount + uint(GROUP) - 1u) / uint(GROUP), first = me * each, end = min(first + each, tileCount);
  uint own = 0u;
  for (uint i = first; i < end; ++i) own += state[kReductionTiles + i];
  tileSums[me] = own;
  barrier();
  for (uint step_ = 1u; step_ < uint(GROUP); step_ *= 2u) {
    const uint left = me >= step_ ? tileSums[me - step_] : 0u;
    barrier();
    tileSums[me] += left;
    barrier();
  }
  uint before = tileSums[me] - own;
  for (uint i = first; i < end; ++i) {
    const uint here = state[kReductionTiles + i];
    state[kReductionTiles + i] = before;
    before += here;
  }
  if (me == uint(GROUP) - 1u) finishCount(tileSums[me]);
}
#endif

#ifdef SCATTER
void scatterTile(uint tile, uint count, uint tileCount) {
  const uint me = gl_LocalInvocationIndex;
#ifdef ADD_UP
  if (me == 0u) sharedWord = 0u;
  uint own = 0u;
  for (uint i = me; i < tile; i += uint(GROUP)) own += state[kReductionTiles + i];
#endif
  Piece pieces[ROWS];
  readTile(tile, count, pieces);
  const TileSlots slots = tileSlots(pieces);
#ifdef ADD_UP
#ifdef SUBGROUPS
  own = subgroupAdd(own);
  if (ownLane() == 0u)
#endif
    atomicAdd(sharedWord, own);
  packTile(pieces, slots);
  barrier();
  const uint before = sharedWord;
  if (me == 0u && tile + 1u == tileCount) finishCount(before + slots.whole);
#else
  packTile(pieces, slots);
  const uint before = state[kReductionTiles + tile];
  barrier();
#endif
  writeTile(pieces, slots, before);
}
#endif

void main() {
  const uint me = gl_LocalInvocationIndex;
#ifdef TICKETS
  // Tiles in the order in which groups start: those that others wait for are under way.
  const bool odd = tilesAt != kReductionTiles;
  if (me == 0u) sharedWord = atomicAdd(state[odd ? kReductionStartedOdd : kReductionStarted], 1u);
  barrier();
  const uint tile = sharedWord;
  if (tile == 0u && me == 0u) state[odd ? kReductionStarted : kReductionStartedOdd] = 0u;
#else
  const uint tile = groupNumber();
#endif
  const uint count = itemCount(), tileCount = max((count + kPerTile - 1u) / kPerTile, 1u);
#ifdef APPEND
  appendTile(tile, count, tileCount);
#elif defined(TILES)
  sumTiles(tileCount);
#else
#ifdef LOOK_BACK
  // Dispatches take turns with two sets of states: each clears the other one's.
  for (uint i = tile * uint(GROUP) + me; i < tilesAtMost; i += gl_NumWorkGroups.x * gl_NumWorkGroups.y * uint(GROUP))
    state[clearedAt + i] = kReductionNothing;
#endif
  if (tile >= tileCount) return;
#if defined(LOOK_BACK)
  lookBackTile(tile, count, tileCount);
#elif defined(COUNT)
  countTile(tile, count);
#else
  scatterTile(tile, count, tileCount);
#endif
#endif
}

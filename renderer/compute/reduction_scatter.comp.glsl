// SPDX-License-Identifier: BSD-3-Clause
// Stream reduction by scan and scatter. See stream_reduction.h. One of LOOK_BACK, COUNT, TILES, SCATTER, APPEND.
#include "renderer/compute/reduction_items.glsl"

layout(local_size_x = kReductionGroup) in;

const uint kPerVector = 4u / uint(LANES);  // items in 16 bytes
const uint kPerRow = uint(kReductionGroup) * kPerVector;
const uint kPerTile = uint(kReductionRows) * kPerRow;

layout(std430, binding = kReductionItemsBuffer) readonly buffer Items { uvec4 items[]; };
#ifdef FLAGGED
#if LANES == 1
layout(std430, binding = kReductionFlagsBuffer) readonly buffer Flags { uvec4 flags[]; };
#else
layout(std430, binding = kReductionFlagsBuffer) readonly buffer Flags { uvec2 flags[]; };
#endif
#endif
layout(std430, binding = kReductionOutBuffer) writeonly buffer Out { ITEM kept[]; };
#ifdef LOOK_BACK
layout(std430, binding = kReductionStateBuffer) coherent volatile buffer State { uint state[]; };
#else
layout(std430, binding = kReductionStateBuffer) buffer State { uint state[]; };
#endif

uniform uint tilesAtMost;

// 16 bytes of items, with a bit for each that is valid: 0 from `count` on.
struct Piece {
  uvec4 items;
  uint valid;
};

Piece pieceAt(uint tile, uint row, uint count) {
  const uint first = tile * kPerTile + row * kPerRow + gl_LocalInvocationIndex * kPerVector;
  Piece piece = Piece(uvec4(0u), 0u);
  if (first >= count) return piece;
  piece.items = items[first / kPerVector];
#ifdef FLAGGED
  const uvec4 valid = uvec4(notEqual(
#if LANES == 1
      flags[first / kPerVector],
#else
      uvec4(flags[first / kPerVector], uvec2(0u)),
#endif
      uvec4(0u)));
#elif LANES == 1
  const uvec4 valid = uvec4(notEqual(piece.items, uvec4(kInvalidItem)));
#else
  const uvec4 valid = uvec4(uvec2(notEqual(piece.items.xz, uvec2(kInvalidItem))), uvec2(0u));
#endif
  piece.valid = valid.x | valid.y << 1 | valid.z << 2 | valid.w << 3;
  if (first + kPerVector > count) piece.valid &= (1u << (count - first)) - 1u;
  return piece;
}

// Counts of four rows, 16 bits each: a row has at most 1,024 items.
uvec2 packedCounts(in Piece pieces[kReductionRows]) {
  return uvec2(bitCount(pieces[0].valid) | bitCount(pieces[1].valid) << 16,
               bitCount(pieces[2].valid) | bitCount(pieces[3].valid) << 16);
}
uint countOfRow(uvec2 packed_, int row) { return (row < 2 ? packed_.x : packed_.y) >> (16 * (row & 1)) & 0xffffu; }

shared uvec2 line[2][kReductionGroup];

// Inclusive sums over the group, left in line[0] since log2 of its 256 invocations is even.
void scanLine(uvec2 own) {
  const uint me = gl_LocalInvocationIndex;
  line[0][me] = own;
  barrier();
  uint from = 0u;
  for (uint step_ = 1u; step_ < uint(kReductionGroup); step_ *= 2u) {
    uvec2 sum = line[from][me];
    if (me >= step_) sum += line[from][me - step_];
    line[1u - from][me] = sum;
    from = 1u - from;
    barrier();
  }
}

uint wholeCount() {
  const uvec2 last = line[0][kReductionGroup - 1];
  const uvec2 pairs = (last & 0xffffu) + (last >> 16);
  return pairs.x + pairs.y;
}

void readTile(uint tile, uint count, out Piece pieces[kReductionRows]) {
  for (int row = 0; row < kReductionRows; ++row) pieces[row] = pieceAt(tile, uint(row), count);
}

void put(uint slot, Piece piece, int i) {
  if (slot >= capacity) return;
#if LANES == 1
  kept[slot] = piece.items[i];
#else
  kept[slot] = i == 0 ? piece.items.xy : piece.items.zw;
#endif
}

// line[0] holds the inclusive sums of the tile.
void writeTile(in Piece pieces[kReductionRows], uint before) {
  const uint me = gl_LocalInvocationIndex;
  const uvec2 left = me == 0u ? uvec2(0u) : line[0][me - 1u];
  const uvec2 whole = line[0][kReductionGroup - 1];
  for (int row = 0; row < kReductionRows; ++row) {
    uint slot = before + countOfRow(left, row);
    for (int i = 0; i < int(kPerVector); ++i)
      if ((pieces[row].valid >> i & 1u) != 0u) put(slot++, pieces[row], i);
    before += countOfRow(whole, row);
  }
}

shared uint sharedWord;

#ifdef LOOK_BACK
shared uint window[kReductionWindow];
const int kSpins = 4096;

// Adds up a tile on behalf of the group that holds it. line[] stays as it is.
uint countForOther(uint tile, uint count) {
  if (gl_LocalInvocationIndex == 0u) sharedWord = 0u;
  barrier();
  uint valid = 0u;
  for (int row = 0; row < kReductionRows; ++row) valid += bitCount(pieceAt(tile, uint(row), count).valid);
  atomicAdd(sharedWord, valid);
  barrier();
  const uint sum = sharedWord;
  barrier();
  return sum;
}

// Valid items of all tiles before `tile`; called by the whole group.
uint countBefore(uint tile, uint count) {
  const uint me = gl_LocalInvocationIndex;
  uint sum = 0u;
  int end = int(tile);
  while (end > 0) {
    if (me < uint(kReductionWindow)) {
      const int other = end - 1 - int(me);
      uint theirs = kReductionAll;
      if (other >= 0) {
        theirs = kReductionNothing;
        for (int spin = 0; spin < kSpins && theirs == kReductionNothing; ++spin) theirs = state[kReductionTiles + other];
      }
      window[me] = theirs;
    }
    barrier();
    int taken = 0;
    bool done = false;
    while (taken < kReductionWindow && !done && window[taken] != kReductionNothing) {
      sum += window[taken] & kReductionCountMask;
      done = window[taken] >= kReductionAll;
      ++taken;
    }
    if (done) break;
    end -= taken;
    // Whoever holds that tile may never run on while this group waits: its tile is added up here.
    if (taken < kReductionWindow) {
      sum += countForOther(uint(end - 1), count);
      --end;
    }
    barrier();
  }
  return sum;
}
#endif

#if defined(LOOK_BACK) || defined(APPEND)
// The last group leaves the state as it found it.
void finishGroup(uint tileCount) {
  const uint me = gl_LocalInvocationIndex;
  barrier();
  if (me == 0u) {
    memoryBarrierBuffer();
    sharedWord = atomicAdd(state[kReductionFinished], 1u);
  }
  barrier();
  if (sharedWord + 1u < gl_NumWorkGroups.x * gl_NumWorkGroups.y) return;
#ifdef APPEND
  if (me == 0u) finishCount(atomicAdd(state[kReductionTotal], 0u));
  barrier();
#else
  for (uint tile = me; tile < tileCount; tile += uint(kReductionGroup)) state[kReductionTiles + tile] = kReductionNothing;
#endif
  if (me < kReductionTiles) state[me] = 0u;
}
#endif

void main() {
  const uint me = gl_LocalInvocationIndex;
  const uint count = itemCount();
  const uint tileCount = max((count + kPerTile - 1u) / kPerTile, 1u);
#if defined(LOOK_BACK) || defined(APPEND)
  // Tiles in the order in which groups start.
  if (me == 0u) sharedWord = atomicAdd(state[kReductionStarted], 1u);
  barrier();
  const uint tile = sharedWord;
  barrier();
  if (tile < tileCount) {
    Piece pieces[kReductionRows];
    readTile(tile, count, pieces);
    scanLine(packedCounts(pieces));
    const uint whole = wholeCount();
#ifdef LOOK_BACK
    if (me == 0u) state[kReductionTiles + tile] = whole | (tile == 0u ? kReductionAll : kReductionOwn);
    uint before = 0u;
    if (tile > 0u) {
      before = countBefore(tile, count);
      if (me == 0u) state[kReductionTiles + tile] = (before + whole) | kReductionAll;
    }
    if (me == 0u && tile + 1u == tileCount) finishCount(before + whole);
#else
    if (me == 0u) sharedWord = atomicAdd(state[kReductionTotal], whole);
    barrier();
    const uint before = sharedWord;
#endif
    writeTile(pieces, before);
  }
  finishGroup(tileCount);
#elif defined(TILES)
  // One group: exclusive sums in place, a group's width at a time.
  uint before = 0u;
  for (uint first = 0u; first < tileCount; first += uint(kReductionGroup)) {
    const uint at = first + me;
    const uint own = at < tileCount ? state[kReductionTiles + at] : 0u;
    barrier();
    scanLine(uvec2(own, 0u));
    if (at < tileCount) state[kReductionTiles + at] = before + line[0][me].x - own;
    before += line[0][kReductionGroup - 1].x;
  }
  if (me == 0u) finishCount(before);
#else
  const uint tile = groupNumber();
  if (tile >= tileCount) return;
  Piece pieces[kReductionRows];
  readTile(tile, count, pieces);
  scanLine(packedCounts(pieces));
#ifdef COUNT
  if (me == 0u) state[kReductionTiles + tile] = wholeCount();
#else
  writeTile(pieces, state[kReductionTiles + tile]);
#endif
#endif
}

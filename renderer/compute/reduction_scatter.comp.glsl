// SPDX-License-Identifier: BSD-3-Clause
// Stream reduction by scan and scatter. See stream_reduction.h. One of LOOK_BACK, COUNT, TILES, SCATTER, APPEND. SUBGROUPS: groups
// consist of subgroups of 32 invocations that can add up and shuffle.
#ifdef SUBGROUPS
#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_shuffle : require
#endif
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

uniform uint tilesAt, clearedAt, tilesAtMost;  // LOOK_BACK: states of this dispatch and of the next

// Number of an invocation in the order of the items.
#ifdef SUBGROUPS
uint ownPlace() { return gl_SubgroupID * 32u + gl_SubgroupInvocationID; }
#else
uint ownPlace() { return gl_LocalInvocationIndex; }
#endif

// 16 bytes of items, with a bit for each that is valid: 0 from `count` on.
struct Piece {
  uvec4 items;
  uint valid;
};

Piece pieceAt(uint tile, uint row, uint place, uint count) {
  const uint first = tile * kPerTile + row * kPerRow + place * kPerVector;
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

#if !defined(SUBGROUPS) || defined(TILES)
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
#endif

#ifdef SUBGROUPS
const uint kSubgroups = uint(kReductionGroup) / 32u;
// Of each row and subgroup, in the order of the items: as many as a subgroup has invocations.
shared uint partCounts[kReductionRows * kSubgroups];

// Slots in the tile's output at which this invocation's items of each row begin; returns how many the tile keeps.
uint tileSlots(in Piece pieces[kReductionRows], out uint slots[kReductionRows]) {
  // Counts of four rows, 8 bits each: a subgroup has at most 128 items of a row.
  uint own = 0u;
  for (int row = 0; row < kReductionRows; ++row) own |= uint(bitCount(pieces[row].valid)) << 8 * row;
  const uint upTo = subgroupInclusiveAdd(own), before = upTo - own;
  if (gl_SubgroupInvocationID == 31u)
    for (int row = 0; row < kReductionRows; ++row)
      partCounts[uint(row) * kSubgroups + gl_SubgroupID] = upTo >> 8 * row & 0xffu;
  barrier();
  const uint part = partCounts[gl_SubgroupInvocationID], upToPart = subgroupInclusiveAdd(part);
  for (int row = 0; row < kReductionRows; ++row)
    slots[row] = subgroupShuffle(upToPart - part, uint(row) * kSubgroups + gl_SubgroupID) + (before >> 8 * row & 0xffu);
  return subgroupShuffle(upToPart, 31u);
}
#else
// Counts of four rows, 16 bits each: a row has at most 1,024 items.
uvec2 packedCounts(in Piece pieces[kReductionRows]) {
  return uvec2(bitCount(pieces[0].valid) | bitCount(pieces[1].valid) << 16,
               bitCount(pieces[2].valid) | bitCount(pieces[3].valid) << 16);
}
uint countOfRow(uvec2 packed_, int row) { return (row < 2 ? packed_.x : packed_.y) >> (16 * (row & 1)) & 0xffffu; }

uint tileSlots(in Piece pieces[kReductionRows], out uint slots[kReductionRows]) {
  const uint me = gl_LocalInvocationIndex;
  scanLine(packedCounts(pieces));
  const uvec2 left = me == 0u ? uvec2(0u) : line[0][me - 1u];
  const uvec2 whole = line[0][kReductionGroup - 1];
  uint before = 0u;
  for (int row = 0; row < kReductionRows; ++row) {
    slots[row] = before + countOfRow(left, row);
    before += countOfRow(whole, row);
  }
  return before;
}
#endif

void readTile(uint tile, uint count, out Piece pieces[kReductionRows]) {
  for (int row = 0; row < kReductionRows; ++row) pieces[row] = pieceAt(tile, uint(row), ownPlace(), count);
}

// The tile's valid items, so that neighbouring invocations write neighbouring places.
shared ITEM packedItems[kPerTile];

void packTile(in Piece pieces[kReductionRows], in uint slots[kReductionRows]) {
  for (int row = 0; row < kReductionRows; ++row) {
    uint slot = slots[row];
    for (int i = 0; i < int(kPerVector); ++i) {
      if ((pieces[row].valid >> i & 1u) == 0u) continue;
#if LANES == 1
      packedItems[slot++] = pieces[row].items[i];
#else
      packedItems[slot++] = i == 0 ? pieces[row].items.xy : pieces[row].items.zw;
#endif
    }
  }
}

// Once packedItems is there.
void writeTile(uint before, uint whole) {
  const uint end = before < capacity ? min(whole, capacity - before) : 0u;
  for (uint i = gl_LocalInvocationIndex; i < end; i += uint(kReductionGroup)) kept[before + i] = packedItems[i];
}

shared uint sharedWord;

#ifdef LOOK_BACK
const int kSpins = 4096;  // of an invocation in all: none follow where groups run in another order
const uint kNoDistance = 0xffffffffu;
#ifdef SUBGROUPS
// Valid items of all tiles before `tile`; called by one subgroup.
uint countBefore(uint tile, uint count) {
  const uint lane = gl_SubgroupInvocationID;
  uint sum = 0u;
  int end = int(tile), spins = kSpins;
  while (end > 0) {
    uint theirs[kReductionLooks];
    for (int i = 0; i < kReductionLooks; ++i) {
      const int other = end - 1 - int(lane) - 32 * i;
      theirs[i] = other < 0 ? kReductionOwn : state[tilesAt + uint(other)];
    }
    uint all, nothing;
    while (true) {
      all = kNoDistance;
      nothing = kNoDistance;
      for (int i = kReductionLooks - 1; i >= 0; --i) {
        if (theirs[i] == kReductionNothing) nothing = lane + uint(32 * i);
        if (theirs[i] >= kReductionAll) all = lane + uint(32 * i);
      }
      all = subgroupMin(all);
      nothing = subgroupMin(nothing);
      if (all <= nothing || spins-- <= 0) break;
      for (int i = 0; i < kReductionLooks; ++i)
        if (theirs[i] == kReductionNothing) theirs[i] = state[tilesAt + uint(end - 1 - int(lane) - 32 * i)];
    }
    uint own = 0u;
    for (int i = 0; i < kReductionLooks; ++i) {
      const uint distance_ = lane + uint(32 * i);
      if (distance_ <= all && distance_ < nothing) own += theirs[i] & kReductionCountMask;
    }
    sum += subgroupAdd(own);
    if (all < nothing) break;
    if (nothing == kNoDistance) {
      end -= 32 * kReductionLooks;
      continue;
    }
    // Whoever holds that tile may never run on while this group waits: its tile is added up here.
    end -= int(nothing) + 1;
    spins = 0;
    uint valid = 0u;
    for (uint row = 0u; row < uint(kReductionRows); ++row)
      for (uint place = lane; place < uint(kReductionGroup); place += 32u)
        valid += bitCount(pieceAt(uint(end), row, place, count).valid);
    sum += subgroupAdd(valid);
  }
  return sum;
}
#else
// Distances of the nearest tile whose sum includes all before it, and of the nearest that nobody has counted.
shared uint nearestAll, nearestNothing;

uint sumOfGroup(uint own) {
  atomicAdd(sharedWord, own);
  barrier();
  return sharedWord;
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
      sharedWord = 0u;
    }
    barrier();
    uint theirs[kReductionLooks];
    for (int i = 0; i < kReductionLooks; ++i) {
      const int other = end - 1 - int(me) - i * kReductionGroup;
      theirs[i] = other < 0 ? kReductionOwn : state[tilesAt + uint(other)];
    }
    uint all = kNoDistance, nothing = kNoDistance;
    for (int i = kReductionLooks - 1; i >= 0; --i) {
      const int other = end - 1 - int(me) - i * kReductionGroup;
      for (; spins > 0 && theirs[i] == kReductionNothing; --spins) theirs[i] = state[tilesAt + uint(other)];
      const uint distance_ = me + uint(i * kReductionGroup);
      if (theirs[i] == kReductionNothing) nothing = distance_;
      if (theirs[i] >= kReductionAll) all = distance_;
    }
    if (all != kNoDistance) atomicMin(nearestAll, all);
    if (nothing != kNoDistance) atomicMin(nearestNothing, nothing);
    barrier();
    const uint farthestTaken = min(nearestAll, nearestNothing - 1u);  // before any: all
    uint own = 0u;
    for (int i = 0; i < kReductionLooks; ++i)
      if (nearestNothing != 0u && me + uint(i * kReductionGroup) <= farthestTaken) own += theirs[i] & kReductionCountMask;
    sum += sumOfGroup(own);
    const bool done = nearestAll < nearestNothing;
    const uint missing = nearestNothing;
    barrier();
    if (done) break;
    if (missing == kNoDistance) {
      end -= kReductionLooks * kReductionGroup;
      continue;
    }
    // Whoever holds that tile may never run on while this group waits: its tile is added up here.
    end -= int(missing) + 1;
    if (me == 0u) sharedWord = 0u;
    barrier();
    uint valid = 0u;
    for (int row = 0; row < kReductionRows; ++row) valid += bitCount(pieceAt(uint(end), uint(row), ownPlace(), count).valid);
    sum += sumOfGroup(valid);
    barrier();
  }
  return sum;
}
#endif
#endif

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
#endif

void main() {
  const uint me = gl_LocalInvocationIndex;
#ifdef LOOK_BACK
  // Tiles in the order in which groups start: those that others wait for are under way.
  const bool odd = tilesAt != kReductionTiles;
  if (me == 0u) sharedWord = atomicAdd(state[odd ? kReductionStartedOdd : kReductionStarted], 1u);
  barrier();
  const uint tile = sharedWord;
#else
  const uint tile = groupNumber();
#endif
  const uint count = itemCount();
  const uint tileCount = max((count + kPerTile - 1u) / kPerTile, 1u);
#ifdef LOOK_BACK
  // Dispatches take turns with two sets of states: each clears the other one's.
  if (tile == 0u && me == 0u) state[odd ? kReductionStarted : kReductionStartedOdd] = 0u;
  for (uint i = tile * uint(kReductionGroup) + me; i < tilesAtMost;
       i += gl_NumWorkGroups.x * gl_NumWorkGroups.y * uint(kReductionGroup))
    state[clearedAt + i] = kReductionNothing;
#endif
#ifdef TILES
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
  if (tile < tileCount) {
    Piece pieces[kReductionRows];
    readTile(tile, count, pieces);
    uint slots[kReductionRows];
    const uint whole = tileSlots(pieces, slots);
#ifdef COUNT
    if (me == 0u) state[kReductionTiles + tile] = whole;
#else
#if defined(LOOK_BACK)
    if (me == 0u) state[tilesAt + tile] = whole | (tile == 0u ? kReductionAll : kReductionOwn);
    packTile(pieces, slots);
#ifdef SUBGROUPS
    if (gl_SubgroupID == 0u) {
      const uint found = countBefore(tile, count);
      if (gl_SubgroupInvocationID == 0u) sharedWord = found;
    }
    barrier();
    const uint before = sharedWord;
#else
    const uint before = countBefore(tile, count);
#endif
    if (me == 0u && tile > 0u) state[tilesAt + tile] = (before + whole) | kReductionAll;
    if (me == 0u && tile + 1u == tileCount) finishCount(before + whole);
#elif defined(APPEND)
    if (me == 0u) sharedWord = atomicAdd(state[kReductionTotal], whole);
    packTile(pieces, slots);
    barrier();
    const uint before = sharedWord;
#else
    packTile(pieces, slots);
    const uint before = state[kReductionTiles + tile];
#endif
    barrier();
    writeTile(before, whole);
#endif
  }
#ifdef APPEND
  finishGroup();
#endif
#endif
}

// SPDX-License-Identifier: BSD-3-Clause
// Tiles of a stream, after reduction_items.glsl: a group of GROUP invocations takes ROWS times 16 bytes each. SUBGROUPS:
// groups consist of subgroups of 32 invocations that can add up and shuffle; else ROWS is 4 at most.

const uint kPerVector = 4u / uint(LANES);  // items in 16 bytes
const uint kPerTile = uint(ROWS) * uint(GROUP) * kPerVector;

layout(std430, binding = kReductionItemsBuffer) readonly buffer Items { uvec4 items[]; };
#ifdef FLAGGED
#if LANES == 1
layout(std430, binding = kReductionFlagsBuffer) readonly buffer Flags { uvec4 flags[]; };
#else
layout(std430, binding = kReductionFlagsBuffer) readonly buffer Flags { uvec2 flags[]; };
#endif
#endif
layout(std430, binding = kReductionOutBuffer) writeonly buffer Out { ITEM kept[]; };

// Number of an invocation in the order of the items.
#ifdef SUBGROUPS
uint ownPlace() { return ownSubgroup() * 32u + ownLane(); }
// A subgroup takes its rows one after another, so that what it keeps is contiguous.
uint vectorAt(uint tile, uint row, uint place) {
  return tile * uint(GROUP * ROWS) + (place / 32u * uint(ROWS) + row) * 32u + place % 32u;
}
#else
uint ownPlace() { return gl_LocalInvocationIndex; }
uint vectorAt(uint tile, uint row, uint place) { return (tile * uint(ROWS) + row) * uint(GROUP) + place; }
#endif

// 16 bytes of items, with a bit for each that is valid: 0 from `count` on.
struct Piece {
  uvec4 items;
  uint valid;
};

Piece pieceAt(uint tile, uint row, uint place, uint count) {
  const uint vector = vectorAt(tile, row, place), first = vector * kPerVector;
  Piece piece = Piece(uvec4(0u), 0u);
  if (first >= count) return piece;
  piece.items = items[vector];
#ifdef FLAGGED
  const uvec4 valid = uvec4(notEqual(
#if LANES == 1
      flags[vector],
#else
      uvec4(flags[vector], uvec2(0u)),
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

void readTile(uint tile, uint count, out Piece pieces[ROWS]) {
  for (int row = 0; row < ROWS; ++row) pieces[row] = pieceAt(tile, uint(row), ownPlace(), count);
}

// Places of one invocation's items: of those of each row within the part of the output of `part`, and that part in the tile's.
struct TileSlots {
  uint rows[ROWS];
  uint partStart, partCount;  // part: the subgroup's items, or the tile's where there are no subgroups
  uint whole;                 // items that the tile keeps
};

#ifdef SUBGROUPS
const uint kSubgroups = uint(GROUP) / 32u;
shared uint partCounts[kSubgroups];

TileSlots tileSlots(in Piece pieces[ROWS]) {
  TileSlots slots;
  slots.partCount = 0u;
  // Counts of up to four rows, 8 bits each: a subgroup has at most 128 items of a row.
  for (int first = 0; first < ROWS; first += 4) {
    uint own = 0u;
    for (int row = first; row < min(first + 4, ROWS); ++row) own |= uint(bitCount(pieces[row].valid)) << 8 * (row - first);
    const uint upTo = subgroupInclusiveAdd(own), before = upTo - own, all = subgroupShuffle(upTo, 31u);
    for (int row = first; row < min(first + 4, ROWS); ++row) {
      slots.rows[row] = slots.partCount + (before >> 8 * (row - first) & 0xffu);
      slots.partCount += all >> 8 * (row - first) & 0xffu;
    }
  }
  if (ownLane() == 0u) partCounts[ownSubgroup()] = slots.partCount;
  barrier();
  const uint part = ownLane() < kSubgroups ? partCounts[ownLane()] : 0u;
  const uint upToPart = subgroupInclusiveAdd(part);
  slots.partStart = subgroupShuffle(upToPart - part, ownSubgroup());
  slots.whole = subgroupShuffle(upToPart, 31u);
  return slots;
}
#else
shared uvec2 line[2][GROUP];

// Inclusive sums over the group, left in line[0] since log2 of its 256 invocations is even.
void scanLine(uvec2 own) {
  const uint me = gl_LocalInvocationIndex;
  line[0][me] = own;
  barrier();
  uint from = 0u;
  for (uint step_ = 1u; step_ < uint(GROUP); step_ *= 2u) {
    uvec2 sum = line[from][me];
    if (me >= step_) sum += line[from][me - step_];
    line[1u - from][me] = sum;
    from = 1u - from;
    barrier();
  }
}

// Counts of up to four rows, 16 bits each: a row has at most 1,024 items.
uint countOfRow(uvec2 packed_, int row) { return (row < 2 ? packed_.x : packed_.y) >> (16 * (row & 1)) & 0xffffu; }

TileSlots tileSlots(in Piece pieces[ROWS]) {
  const uint me = gl_LocalInvocationIndex;
  uvec2 own = uvec2(0u);
  for (int row = 0; row < ROWS; ++row) {
    const uint valid = uint(bitCount(pieces[row].valid)) << (16 * (row & 1));
    own += row < 2 ? uvec2(valid, 0u) : uvec2(0u, valid);
  }
  scanLine(own);
  const uvec2 left = me == 0u ? uvec2(0u) : line[0][me - 1u], all = line[0][GROUP - 1];
  TileSlots slots;
  slots.partStart = 0u;
  slots.partCount = 0u;
  for (int row = 0; row < ROWS; ++row) {
    slots.rows[row] = slots.partCount + countOfRow(left, row);
    slots.partCount += countOfRow(all, row);
  }
  slots.whole = slots.partCount;
  return slots;
}
#endif

// Valid items of part of a tile, PACKED_ROWS rows at a time, so that neighbouring invocations write neighbouring places.
#ifdef SUBGROUPS
const int kPackedRows = min(ROWS, 4);
const uint kPartInvocations = 32u;
uint partInvocation() { return ownLane(); }
uint ownPart() { return ownSubgroup(); }
void partBarrier() {
  subgroupMemoryBarrierShared();
  subgroupBarrier();
}
#else
const int kPackedRows = ROWS;
const uint kPartInvocations = uint(GROUP);
uint partInvocation() { return gl_LocalInvocationIndex; }
uint ownPart() { return 0u; }
void partBarrier() { barrier(); }
#endif
const uint kPartRoom = uint(kPackedRows) * kPartInvocations * kPerVector;
shared ITEM packedItems[uint(kPackedRows) * uint(GROUP) * kPerVector];

// Where what the part keeps of the rows from `first` on begins: known to the last invocation alone without this.
uint rowStart(in TileSlots slots, int row) {
#ifdef SUBGROUPS
  return row == 0 ? 0u : row >= ROWS ? slots.partCount : subgroupShuffle(slots.rows[row], 0u);
#else
  return 0u;
#endif
}

void packRows(in Piece pieces[ROWS], in TileSlots slots, int first, uint start) {
  for (int row = first; row < first + kPackedRows; ++row) {
    uint at = ownPart() * kPartRoom + slots.rows[row] - start;
    for (int i = 0; i < int(kPerVector); ++i) {
      if ((pieces[row].valid >> i & 1u) == 0u) continue;
#if LANES == 1
      packedItems[at++] = pieces[row].items[i];
#else
      packedItems[at++] = i == 0 ? pieces[row].items.xy : pieces[row].items.zw;
#endif
    }
  }
}

// `to`: place in the output of the first of `length` packed items.
void writePacked(uint to, uint length) {
  const uint end = to < capacity ? min(length, capacity - to) : 0u;
  for (uint i = partInvocation(); i < end; i += kPartInvocations) kept[to + i] = packedItems[ownPart() * kPartRoom + i];
}

// The first rows, before it is known where they go: whoever packed them writes them once partBarrier() or barrier() has passed.
void packTile(in Piece pieces[ROWS], in TileSlots slots) { packRows(pieces, slots, 0, 0u); }

// `before`: items that tiles before this one keep.
void writeTile(in Piece pieces[ROWS], in TileSlots slots, uint before) {
  uint start = 0u;
  for (int first = 0; first < ROWS; first += kPackedRows) {
    if (first > 0) {
      partBarrier();
      packRows(pieces, slots, first, start);
      partBarrier();
    }
    const uint next = first + kPackedRows >= ROWS ? slots.partCount : rowStart(slots, first + kPackedRows);
    writePacked(before + slots.partStart + start, next - start);
    start = next;
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// The picture of points: pixels' own, then rows of tiles of further ones, so that work groups are full.

uniform ivec2 sizePx;    // of the frame
uniform ivec2 pointsPx;  // multiples of a tile's side
uniform int ownRows;     // of pixels' own points, a multiple of a tile's side

// Where the i-th further point is.
ivec2 furtherPoint(uint i) {
  const int tile = int(i) / (kGroupSide * kGroupSide), lane = int(i) % (kGroupSide * kGroupSide), tiles = pointsPx.x / kGroupSide;
  return ivec2(tile % tiles, tile / tiles) * kGroupSide + ivec2(lane % kGroupSide, lane / kGroupSide + ownRows);
}

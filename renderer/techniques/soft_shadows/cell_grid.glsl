// SPDX-License-Identifier: BSD-3-Clause
// An area of the map divided into cells, and the texel that stands for each: see search_cells.glsl. Needs allowedPerAxis, the
// root of the pixel's budget.
uniform float middleWidth;   // of cells in the middle, as a share of the mean
uniform float shareRoot;     // of the budget that cells use: its square root
uniform uint texelsSpread;   // width of a cell about its middle in which its texel lies, in 2^-16 of the cell's

// Largest number of cells along an axis; 16384: no limit.
int allowedCells() {
  // A product that is a whole number may come out a little too small.
  return allowedPerAxis >= 16384 ? allowedPerAxis : max(int(float(allowedPerAxis) * shareRoot + 1e-3), 1);
}

// Cells along an axis, and the texels that they divide.
struct Cells {
  int low, extent, count;
  float middle;
};

Cells cellsAlong(int low, int high) {
  const int extent = high - low, count = min(extent, allowedCells());
  // No cell is narrower than a texel.
  return Cells(low, extent, count, max(middleWidth, float(count) / float(extent)));
}

// Lower bound of a cell.
int cellBound(Cells cells, int i) {
  const float s = 2.0 * float(i) / float(cells.count) - 1.0;  // from -1 to 1
  const float place = cells.middle * s + (1.0 - cells.middle) * s * abs(s);
  return cells.low + int(floor((0.5 + 0.5 * place) * float(cells.extent) + 0.5));
}

// Begin of the cell below that of bounds low and high, which may lie outside of the area, of the same width.
int boundBelow(Cells cells, int i, int low, int high) { return i > 0 ? cellBound(cells, i - 1) : max(2 * low - high, 0); }

// A row or a column of cells: its bounds in texels, and what it says of the texels that stand for its cells.
struct Strip {
  int low, high;
  bool hasReceiver;
  uint place;  // along the other axis, in 2^-16 of the cell
};
ivec2 receiverTexel = ivec2(-1);  // that the receiver lies in

// Multiples of the golden section fill a turn (2^32) evenly, however many there are; of opposite signs on the two axes, the
// offsets do so across both diagonals, too.
uint placeOfTexels(uint multiple) {
  const uint turn = multiple * 2654435769u + 0x80000000u;
  return ((0x10000u - texelsSpread) >> 1) + (((turn >> 16) * texelsSpread) >> 16);
}
Strip rowOf(int row, int low, int high) {
  return Strip(low, high, receiverTexel.y >= low && receiverTexel.y < high, placeOfTexels(uint(row)));
}
Strip columnOf(int column, int low, int high) {
  return Strip(low, high, receiverTexel.x >= low && receiverTexel.x < high, placeOfTexels(uint(-column)));
}

// The texel that stands for a cell.
ivec2 cellTexel(Strip column, Strip row) {
  if (column.hasReceiver && row.hasReceiver) return receiverTexel;
  return ivec2(column.low + int((row.place * uint(column.high - column.low)) >> 16),
               row.low + int((column.place * uint(row.high - row.low)) >> 16));
}

// As projectionScale(), where the light is widened as for the search area.
vec2 widenedScale(float z, float pz, vec2 largest) { return min(vec2(z / (pz - z)), largest); }

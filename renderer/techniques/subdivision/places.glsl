// SPDX-License-Identifier: BSD-3-Clause
// Where a patch's fine vertices are and which drawn vertices they become. CORNERS: 3 or 4. A place counts segments of a
// patch of n: steps towards corners 1 and 2 of a triangle, 1 and 3 of a quad.

uniform uint firstEdgeVertex, firstInnerVertex;

const int kInner = -1;

// The side of a place: 0.. sides, 8.. corners, or kInner. `along`: segments from the side's first corner.
int sideOf(ivec2 place, int n, out int along) {
#if CORNERS == 3
  const int rest = n - place.x - place.y;
  along = 0;
  if (rest == n) return 8;
  if (place.x == n) return 9;
  if (place.y == n) return 10;
  if (place.y == 0) return along = place.x, 0;
  if (rest == 0) return along = place.y, 1;
  if (place.x == 0) return along = rest, 2;
#else
  along = 0;
  if (place.y == 0 && place.x == 0) return 8;
  if (place.y == 0 && place.x == n) return 9;
  if (place.y == n && place.x == n) return 10;
  if (place.y == n && place.x == 0) return 11;
  if (place.y == 0) return along = place.x, 0;
  if (place.x == n) return along = place.y, 1;
  if (place.y == n) return along = n - place.x, 2;
  if (place.x == 0) return along = n - place.y, 3;
#endif
  return kInner;
}

ivec2 placeOnSide(int side, int along, int n) {
#if CORNERS == 3
  return side == 0 ? ivec2(along, 0) : side == 1 ? ivec2(n - along, along) : ivec2(0, n - along);
#else
  return side == 0 ? ivec2(along, 0) : side == 1 ? ivec2(n, along) : side == 2 ? ivec2(n - along, n) : ivec2(0, n - along);
#endif
}

ivec2 placeOfCorner(int corner, int n) {
#if CORNERS == 3
  return corner == 0 ? ivec2(0) : corner == 1 ? ivec2(n, 0) : ivec2(0, n);
#else
  return corner == 0 ? ivec2(0) : corner == 1 ? ivec2(n, 0) : corner == 2 ? ivec2(n) : ivec2(0, n);
#endif
}

uint drawnVertex(uint patchNumber, SubdivisionPatch record, ivec2 place, int n) {
  int along;
  const int side = sideOf(place, n, along);
  if (side >= 8) return record.corners[side - 8];
  if (side >= 0) {
    if (((record.writes >> (8 + side)) & 1u) != 0u) along = n - along;
    return firstEdgeVertex + record.edges[side] * uint(n - 1) + uint(along - 1);
  }
#if CORNERS == 3
  const int inner = (n - 1) * (n - 2) / 2, row = place.y - 1;
  return firstInnerVertex + patchNumber * uint(inner) + uint(row * (n - 1) - row * (row + 1) / 2 + place.x - 1);
#else
  return firstInnerVertex + patchNumber * uint((n - 1) * (n - 1)) + uint((place.y - 1) * (n - 1) + place.x - 1);
#endif
}

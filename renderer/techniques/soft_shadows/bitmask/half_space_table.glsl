// SPDX-License-Identifier: BSD-3-Clause
// Mask of a convex hull as the intersection of its edges' half-spaces, whose masks stand in a table by the angle and the
// distance of the edge. Schwarz 2009, section 4.4.4. The samples may lie anywhere.
//
// The thesis tabulates all directions of an edge; here an edge that points downwards takes the complement of its reverse,
// so that hulls on both sides of an edge share no sample and leave none out, however coarse the table. half_space_table.h
// states the table's layout.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

layout(binding = kHalfSpacesUnit) uniform usampler2DArray halfSpaces;

#define TABLE_LAYERS ((MASK_WORDS + 3) / 4)
const int kTableSide = 32;  // of the grid of convexHull; the samples need none

struct HalfSpace {
  ivec2 texel;
  uint complement;  // all bits set where the table's mask is to be inverted
};

// Half-space to the left of an edge that has a length.
HalfSpace halfSpaceOf(ivec2 a, ivec2 b) {
  const bool reversed = b.y < a.y || (b.y == a.y && b.x < a.x);
  const ivec2 from = reversed ? b : a, to = reversed ? a : b;
  const vec2 along = vec2(to - from);
  // The distance from the end nearer to the light has the least rounding.
  const ivec2 outFrom = abs(from), outTo = abs(to);
  const vec2 near = vec2(max(outFrom.x, outFrom.y) <= max(outTo.x, outTo.y) ? from : to) / float(kTableSide * kSteps);
  float distance = (along.x * near.y - along.y * near.x) / length(along);
  int column = int(roundEven(atan(along.y, along.x) * (float(TABLE_SIZE) / 3.14159265358979)));
  bool inverted = reversed;
  if (column >= TABLE_SIZE) {  // an angle of pi is one of 0, seen from the other side
    column = 0;
    distance = -distance;
    inverted = !inverted;
  }
  const float row = (distance * 0.70710678118654752 + 1.0) * (0.5 * float(TABLE_SIZE - 1));
  return HalfSpace(ivec2(column, int(roundEven(clamp(row, 0.0, float(TABLE_SIZE - 1))))), inverted ? 0xffffffffu : 0u);
}

void addQuadToMask(vec2 cornerA, vec2 cornerB, vec2 cornerC, vec2 cornerD) {
  const vec2 low = min(min(cornerA, cornerB), min(cornerC, cornerD)),
             high = max(max(cornerA, cornerB), max(cornerC, cornerD));
  if (any(lessThanEqual(high, vec2(0.0))) || any(greaterThanEqual(low, vec2(1.0)))) return;
  ivec2 hull[4];
  if (!convexHull(toSteps(cornerA, kTableSide), toSteps(cornerB, kTableSide), toSteps(cornerC, kTableSide),
                  toSteps(cornerD, kTableSide), hull))
    return;
  const bool triangle = hull[2] == hull[3];
  HalfSpace edges[4];
  for (int i = 0; i < 4; ++i) edges[i] = halfSpaceOf(hull[i], hull[(i + 1) & 3]);
  // 128 samples at a time.
  for (int layer = 0; layer < TABLE_LAYERS; ++layer) {
    uvec4 inside = uvec4(0xffffffffu);
    for (int i = 0; i < 4; ++i)
      if (i != 2 || !triangle)
        inside &= texelFetch(halfSpaces, ivec3(edges[i].texel, layer), 0) ^ uvec4(edges[i].complement);
    for (int i = 0; i < min(MASK_WORDS, 4); ++i) mask[4 * layer + i] |= inside[i];
  }
}

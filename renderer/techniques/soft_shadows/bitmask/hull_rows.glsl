// SPDX-License-Identifier: BSD-3-Clause
// Mask of a convex hull, row by row of samples: the rows' intervals between the hull's edges are worked out directly and
// entered with one bitfieldInsert each, where the thesis joins one mask for each edge (Schwarz 2009, section 4.4.4).
//
// The rule for samples on an edge is that of rectangles (x0 < s <= x1, y0 < s <= y1): a sample counts as lying a little to
// the left of its place, and far less below it.
#include "renderer/techniques/soft_shadows/bitmask/mask_rows.glsl"

// Number of places k * kSteps + offset, k = 0 .. kSamplesAlong - 1, at or below v.
int placesUpTo(int v, int offset) { return clamp(((v - offset) >> 12) + 1, 0, kSamplesAlong); }

// Number of samples of the row at `height` that lie on the edge or to its left; lower.y < height <= upper.y.
int samplesUpToEdge(ivec2 lower, ivec2 upper, int height, int offset) {
  const ivec2 edge = upper - lower;
  const float start = float(lower.x - offset), run = float(edge.x);
  const float crossing = start + float(height - lower.y) * (run / float(edge.y));
  const float place = clamp(crossing / float(kSteps), -1.0, float(kSamplesAlong));
  // Rounding: less than eight parts in 2^24 of either length, and what the conversion to samples adds.
  const float nearest = roundEven(place);
  const float rounding = (exp2(-20.0) * (abs(start) + abs(run)) + 0.25) / float(kSteps);
  if (abs(place - nearest) > rounding) return clamp(int(floor(place)) + 1, 0, kSamplesAlong);
  const int candidate = int(nearest);
  const int across = candidate * kSteps + offset - lower.x;
  const bool within = compareProducts(across, edge.y, height - lower.y, edge.x) <= 0;
  return clamp(candidate + int(within), 0, kSamplesAlong);
}

// Bits of the samples of a row that lie within the hull: each row crosses one edge upwards and one downwards.
uint rowWithin(ivec2 hull[4], int height, int offset) {
  int first = 0, end = 0;
  for (int i = 0; i < 4; ++i) {
    const ivec2 a = hull[i], b = hull[(i + 1) & 3];
    const bool upwards = a.y < height && height <= b.y, downwards = b.y < height && height <= a.y;
    if (!upwards && !downwards) continue;
    const int samples = samplesUpToEdge(upwards ? a : b, upwards ? b : a, height, offset);
    if (upwards) end = samples;
    else first = samples;
  }
  return bitRange(first, end);
}

void addQuadToMask(vec2 cornerA, vec2 cornerB, vec2 cornerC, vec2 cornerD) {
  const ivec2 a = toSteps(cornerA, kSamplesAlong), b = toSteps(cornerB, kSamplesAlong), c = toSteps(cornerC, kSamplesAlong),
              d = toSteps(cornerD, kSamplesAlong);
  const ivec2 low = min(min(a, b), min(c, d)), high = max(max(a, b), max(c, d));
#if SAMPLE_PLACES == SAMPLE_PLACES_JITTERED_GRID
  const int kFirst = kSteps / 4, kLast = 3 * kSteps / 4;
#else
  const int kFirst = kSteps / 2, kLast = kSteps / 2;
#endif
  const int firstRow = placesUpTo(low.y, kLast), endRow = placesUpTo(high.y, kFirst);
  if (firstRow >= endRow || placesUpTo(low.x, kLast) >= placesUpTo(high.x, kFirst)) return;
  ivec2 hull[4];
  if (!convexHull(a, b, c, d, hull)) return;
  for (int j = firstRow; j < endRow; ++j) {
    const int height = j * kSteps;
#if SAMPLE_PLACES == SAMPLE_PLACES_JITTERED_GRID
    const int offset = (j & 1) == 0 ? kFirst : kLast;
    const uint even = rowWithin(hull, height + kLast, offset), odd = rowWithin(hull, height + kFirst, offset);
    addRow(j, joinedColumns(even, odd));
#else
    addRow(j, rowWithin(hull, height + kFirst, kFirst));
#endif
  }
}

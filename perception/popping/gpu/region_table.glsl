// SPDX-License-Identifier: BSD-3-Clause
// What the region kernels share: buffers, a region's record, sums that do not depend on the order of additions.
const uint kNone = 0xffffffffu;  // parent of a pixel below the threshold

// Parent of each pixel in its tree; a root is its own parent and the first pixel of its region, row by row.
layout(binding = 0, std430) coherent buffer Parents { uint parents[]; };
// Of a tile's root: 1 if the tile's part holds a seed. Later, of a region's root: label, 0 without a seed.
layout(binding = 1, std430) coherent buffer Roots { uint roots[]; };
// [0]: regions. Then by label - 1.
struct Region {
  uint sizePx;
  uint sum[4];       // of (jnd / threshold)^p, fixed point: least word first, units of 2^-16
  uint largestBits;  // of the jnd, as floatBitsToUint
  uint leastX, leastY, mostX, mostY;
  uint x0, x1, y0, y1;  // sums of pixel coordinates, 64 bits each
  float sigma, rating;
};
layout(binding = 2, std430) buffer Table {
  uint regionCount, unused0, unused1, unused2;
  Region regions[];
};

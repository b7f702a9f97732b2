// SPDX-License-Identifier: BSD-3-Clause
// What the region kernels share: buffers, a region's record, sums that do not depend on the order of additions.
#include "perception/popping/gpu/popping_bindings.h"

const uint kNone = 0xffffffffu;  // parent of a pixel below the threshold

// Parent of each pixel in its tree; a root is its own parent and the first pixel of its region, row by row.
layout(binding = kRegionParentsBuffer, std430) coherent buffer Parents { uint parents[]; };
// Of a tile's root: 1 if the tile's part holds a seed. Later, of a region's root: label, 0 without a seed.
layout(binding = kRegionRootsBuffer, std430) coherent buffer Roots { uint roots[]; };
layout(binding = kRegionTableBuffer, std430) buffer Table {
  RegionTableHeader table;
  RegionRecord regions[];
};

// SPDX-License-Identifier: BSD-3-Clause
// A search area as a grid of cells, as many as the budget allows, each a rectangle at the depth of one of its texels: in place
// of texels of a level, whose sides are powers of two, so that 16 x 16 cells take an area of 17 x 40 texels where levels
// allow for 5 x 10. Own form; no source.
//
// An occluder in the middle of the area hides some of the light at whatever depth it lies, one at the rim only if it is as near to the
// light as the nearest of the area; and the nearer to the receiver, the fewer texels cover the light. So cells are
// narrower in the middle. A cell's bounds are whole texels: cells neither overlap nor leave texels out.
//
// Which of its texels a cell reads follows from the cell's place in the map, and not from the pixel.
uniform float middleWidth;  // of cells in the middle, as a share of the mean

// Cells along an axis, and the texels that they divide.
struct Cells {
  int low, extent, count;
  float middle, step;
};

Cells cellsAlong(int low, int high) {
  const int extent = high - low, count = min(extent, allowedPerAxis);
  // No cell is narrower than a texel.
  return Cells(low, extent, count, max(middleWidth, float(count) / float(extent)), 2.0 / float(count));
}

// Lower bound of a cell.
int cellBound(Cells cells, int i) {
  const float s = cells.step * float(i) - 1.0;  // from -1 to 1
  const float place = s * (cells.middle + (1.0 - cells.middle) * abs(s));
  return cells.low + int(floor(0.5 * float(cells.extent) * (1.0 + place) + 0.5));
}

// Begin of the cell below that of bounds low and high, which may lie outside of the area, of the same width.
int boundBelow(Cells cells, int i, int low, int high) { return i > 0 ? cellBound(cells, i - 1) : max(2 * low - high, 0); }

// The texel that stands for a cell, by a lattice as in sampled_texel.glsl.
ivec2 cellTexel(ivec2 low, ivec2 high) {
#ifdef DEPTHS_CENTRE
  return (low + high) >> 1;
#else
  const uvec2 t = uvec2(low), offset = uvec2(t.x * 3679390609u + t.y * 3152041523u, t.x * 2700274806u + t.y * 2313257605u);
  return low + ivec2(((offset >> 16) * uvec2(high - low)) >> 16);
#endif
}

struct CellDepth {
  float z;
  ivec2 texel;
};

// None, if the cell lies outside of the map.
CellDepth cellDepth(ivec2 low, ivec2 high) {
  if (any(greaterThanEqual(low, high))) return CellDepth(kEmptyDepth, ivec2(0));
  const ivec2 texel = cellTexel(low, high);
  ++fetchCount;
  return CellDepth(texelFetch(minimumMap, texel, 0).x, texel);
}

bool cellBlocks(CellDepth cell, vec4 p, float depth) { return blocks(cell.z, cell.texel, 0, p, depth); }

// As projectionScale(), where the light is widened as for the search area.
vec2 widenedScale(float z, float pz, vec2 largest) { return min(vec2(projectionScale(z, pz)), largest); }

// Cells above each other that are visited together, so that one is the next one's neighbour below without being read again.
#define ROWS_TOGETHER 4

// Visibility by the cells of an area.
float gatherOccluders(vec4 p, Area area, int level) {
  const Cells columns = cellsAlong(area.low.x, area.high.x), rows = cellsAlong(area.low.y, area.high.y);
  if (float(columns.count + 1) * float(rows.count) > float(maxIterations)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  const float depth = biasedDepth(p, 0);
  // Unit light coordinates of edge e (in texels) thrown by k: k (scale e + shift) + eyeOnLight.
  const vec2 scale = p.z * tangentSize / (float(resolution) * lightSize);
  const vec2 shift = (p.z * tangentLow - p.xy) / lightSize;
  const vec2 largest = 1.0 / (scale * leastWidth);
  const int firstColumn = boundBelow(columns, 0, columns.low, cellBound(columns, 1));
  // Rows of this invocation: neighbours.
  const int share = (rows.count + rowStep - 1) / rowStep, endRow = min((firstRow + 1) * share, rows.count);
  for (int row = firstRow * share; row < endRow; row += ROWS_TOGETHER) {
    const int together = min(endRow - row, ROWS_TOGETHER);
    int bounds[ROWS_TOGETHER + 1];
    for (int i = 0; i <= ROWS_TOGETHER; ++i) bounds[i] = cellBound(rows, min(row + i, endRow));
    const int below = boundBelow(rows, row, bounds[0], bounds[1]);
    int low = columns.low;
#if GAP_FILL != GAP_FILL_NONE
    CellDepth left[ROWS_TOGETHER];
    bool leftBlocks[ROWS_TOGETHER];
    for (int i = 0; i < ROWS_TOGETHER; ++i) {
      left[i] = cellDepth(ivec2(firstColumn, bounds[i]), ivec2(low, bounds[i + 1]));
      leftBlocks[i] = cellBlocks(left[i], p, depth);
    }
#if GAP_FILL == GAP_FILL_DIAGONAL
    CellDepth lowerLeft = cellDepth(ivec2(firstColumn, below), ivec2(low, bounds[0]));
    bool lowerLeftBlocks = cellBlocks(lowerLeft, p, depth);
#endif
#endif
    for (int x = 0; x < columns.count; ++x) {
      const int high = cellBound(columns, x + 1);
      const vec2 edgesX = scale.x * vec2(float(low), float(high)) + shift.x;
#if GAP_FILL != GAP_FILL_NONE
      CellDepth lower = cellDepth(ivec2(low, below), ivec2(high, bounds[0]));
      bool lowerBlocks = cellBlocks(lower, p, depth);
#if GAP_FILL == GAP_FILL_DIAGONAL
      CellDepth corner = lowerLeft;
      bool cornerBlocks = lowerLeftBlocks;
      lowerLeft = lower;
      lowerLeftBlocks = lowerBlocks;
#endif
#endif
      for (int i = 0; i < ROWS_TOGETHER; ++i) {
        if (i >= together) break;
        const CellDepth own = cellDepth(ivec2(low, bounds[i]), ivec2(high, bounds[i + 1]));
        const bool blocking = cellBlocks(own, p, depth);
        ++examinedCount;
        if (blocking) {
          const vec2 edgesY = scale.y * vec2(float(bounds[i]), float(bounds[i + 1])) + shift.y;
          const vec2 k = widenedScale(own.z, p.z, largest);
          vec2 start = k * vec2(edgesX.x, edgesY.x) + eyeOnLight;
          const vec2 end = k * vec2(edgesX.y, edgesY.y) + eyeOnLight;
#if GAP_FILL != GAP_FILL_NONE
          if (leftBlocks[i])
            start.x = stretchedTo(start.x, widenedScale(left[i].z, p.z, largest).x * edgesX.x + eyeOnLight.x);
          if (lowerBlocks) start.y = stretchedTo(start.y, widenedScale(lower.z, p.z, largest).y * edgesY.x + eyeOnLight.y);
#endif
#if GAP_FILL == GAP_FILL_DIAGONAL
          if (cornerBlocks)
            start = min(start, widenedScale(corner.z, p.z, largest) * vec2(edgesX.x, edgesY.x) + eyeOnLight);
#endif
          accumulateOnLight(start, end);
        }
#if GAP_FILL != GAP_FILL_NONE
#if GAP_FILL == GAP_FILL_DIAGONAL
        corner = left[i];
        cornerBlocks = leftBlocks[i];
#endif
        left[i] = own;
        leftBlocks[i] = blocking;
        lower = own;
        lowerBlocks = blocking;
#endif
      }
      low = high;
    }
    if (isSaturated()) return 0.0;
  }
  return gatheredVisibility();
}

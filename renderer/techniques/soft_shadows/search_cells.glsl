// SPDX-License-Identifier: BSD-3-Clause
// A search area as a grid of cells, as many as a share of the budget allows, each a rectangle at the depth of one of its texels: in place
// of texels of a level, whose sides are powers of two, so that 16 x 16 cells take an area of 17 x 40 texels where levels
// allow for 5 x 10. Own form; no source.
//
// An occluder in the middle of the area hides some of the light at whatever depth it lies, one at the rim only if it is as near to the
// light as the nearest of the area; and the nearer to the receiver, the fewer texels cover the light. So cells are
// narrower in the middle. A cell's bounds are whole texels: cells neither overlap nor leave texels out.
//
// Which of its texels a cell reads follows from its row and column: in the cells along an edge, whether it runs along an axis or
// a diagonal, the texels lie at all distances from it, evenly spread, so that it covers as many of the cells as it should. Only the
// cell around the receiver's own place reads the texel there: at little less than the receiver's depth, it hides all of the light.
#include "renderer/techniques/soft_shadows/cell_grid.glsl"

struct CellDepth {
  float z;
  ivec2 texel;
};

// None, if the cell lies outside of the map.
CellDepth cellDepth(ivec2 low, ivec2 high, ivec2 cell) {
  if (any(greaterThanEqual(low, high))) return CellDepth(kEmptyDepth, ivec2(0));
  const ivec2 texel = cellTexel(low, high, cell);
  ++fetchCount;
  return CellDepth(minimumDepth(texel, 0), texel);
}

bool cellBlocks(CellDepth cell, vec4 p, float depth) { return blocks(cell.z, cell.texel, 0, p, depth); }

// Visibility by the cells of an area.
float gatherOccluders(vec4 p, Area area, int level) {
  const Cells columns = cellsAlong(area.low.x, area.high.x), rows = cellsAlong(area.low.y, area.high.y);
  if (float(columns.count + 1) * float(rows.count) > float(maxIterations)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  receiverTexel = ivec2(floor(mapTexel(p.xy / p.z)));
  const float depth = biasedDepth(p, 0);
  // Unit light coordinates of edge e (in texels) thrown by k: k (scale e + shift) + eyeOnLight.
  const vec2 scale = p.z * tangentSize / (float(resolution) * lightSize);
  const vec2 shift = (p.z * tangentLow - p.xy) / lightSize;
  const vec2 largest = 1.0 / (scale * leastWidth);
  for (int y = firstRow; y < rows.count; y += rowStep) {
    const ivec2 boundsY = ivec2(cellBound(rows, y), cellBound(rows, y + 1));
    const vec2 edgesY = scale.y * vec2(boundsY) + shift.y;
    ivec2 boundsX = ivec2(0, columns.low);
#if GAP_FILL != GAP_FILL_NONE
    const int below = boundBelow(rows, y, boundsY.x, boundsY.y);
    const int first = boundBelow(columns, 0, columns.low, cellBound(columns, 1));
    CellDepth left = cellDepth(ivec2(first, boundsY.x), ivec2(columns.low, boundsY.y), ivec2(-1, y));
    bool leftBlocks = cellBlocks(left, p, depth);
#if GAP_FILL == GAP_FILL_DIAGONAL
    CellDepth lowerLeft = cellDepth(ivec2(first, below), ivec2(columns.low, boundsY.x), ivec2(-1, y - 1));
#endif
#endif
    for (int x = 0; x < columns.count; ++x) {
      boundsX = ivec2(boundsX.y, cellBound(columns, x + 1));
      const CellDepth own = cellDepth(ivec2(boundsX.x, boundsY.x), ivec2(boundsX.y, boundsY.y), ivec2(x, y));
      ++examinedCount;
#if GAP_FILL != GAP_FILL_NONE
      const CellDepth lower = cellDepth(ivec2(boundsX.x, below), ivec2(boundsX.y, boundsY.x), ivec2(x, y - 1));
#endif
      const bool blocking = cellBlocks(own, p, depth);
      if (blocking) {
        const vec2 edgesX = scale.x * vec2(boundsX) + shift.x;
        const vec2 k = widenedScale(own.z, p.z, largest);
        vec2 start = k * vec2(edgesX.x, edgesY.x) + eyeOnLight;
        const vec2 end = k * vec2(edgesX.y, edgesY.y) + eyeOnLight;
#if GAP_FILL != GAP_FILL_NONE
        if (leftBlocks) start.x = stretchedTo(start.x, widenedScale(left.z, p.z, largest).x * edgesX.x + eyeOnLight.x);
        if (cellBlocks(lower, p, depth)) start.y = stretchedTo(start.y, widenedScale(lower.z, p.z, largest).y * edgesY.x + eyeOnLight.y);
#endif
#if GAP_FILL == GAP_FILL_DIAGONAL
        if (cellBlocks(lowerLeft, p, depth))
          start = min(start, widenedScale(lowerLeft.z, p.z, largest) * vec2(edgesX.x, edgesY.x) + eyeOnLight);
#endif
        accumulateOnLight(start, end);
      }
#if GAP_FILL != GAP_FILL_NONE
      left = own;
      leftBlocks = blocking;
#if GAP_FILL == GAP_FILL_DIAGONAL
      lowerLeft = lower;
#endif
#endif
    }
    if (isSaturated()) return 0.0;
  }
  return gatheredVisibility();
}

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
CellDepth cellDepth(Strip column, Strip row) {
  if (column.low >= column.high || row.low >= row.high) return CellDepth(kEmptyDepth, ivec2(0));
  const ivec2 texel = cellTexel(column, row);
  ++fetchCount;
  return CellDepth(minimumDepth(texel, 0), texel);
}

#ifdef BIAS_PLANE
// beforePlane() of texels, which is linear in them: a depth times (planeOrigin + planeStep . texel) lies before planeLimit.
float planeOrigin, planeLimit;
vec2 planeStep;
void preparePlane(vec4 p) {
  const vec2 perTexel = tangentSize / float(resolution);
  planeStep = receiverPlane * perTexel;
  planeOrigin = 1.0 + dot(receiverPlane, tangentLow + 0.5 * perTexel - p.xy / p.z);
  planeLimit = p.z * (1.0 - planeMargin(slopeBias + depthSpread(0)));
  if (eyeIsBehind) planeLimit = 2.0 * p.z - planeLimit;
}
bool cellBlocks(CellDepth cell, vec4 p, float depth) {
  const float scaled = cell.z * (planeOrigin + dot(planeStep, vec2(cell.texel)));
  return cell.z < depth && (eyeIsBehind ? scaled > planeLimit : scaled < planeLimit);
}
#else
void preparePlane(vec4 p) {}
bool cellBlocks(CellDepth cell, vec4 p, float depth) { return blocks(cell.z, cell.texel, 0, p, depth); }
#endif

// Rows that an invocation gathers together, column by column, so that it reads a cell once for itself and for the cell above.
const int kBandRows = 3;

// Visibility by the cells of an area. Of invocations that share a pixel, each has adjoining rows.
float gatherOccluders(vec4 p, Area area, int level) {
  const Cells columns = cellsAlong(area.low.x, area.high.x), rows = cellsAlong(area.low.y, area.high.y);
  if (float(columns.count + 1) * float(rows.count + kBandRows - 1) > float(maxIterations)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  receiverTexel = ivec2(floor(mapTexel(p.xy / p.z)));
  const float depth = biasedDepth(p, 0);
  preparePlane(p);
  // Unit light coordinates of edge e (in texels) thrown by k: k (scale e + shift) + eyeOnLight.
  const vec2 scale = p.z * tangentSize / (float(resolution) * lightSize);
  const vec2 shift = (p.z * tangentLow - p.xy) / lightSize;
  const vec2 largest = 1.0 / (scale * leastWidth);
  const int perInvocation = (rows.count + rowStep - 1) / rowStep;
  const int endRow = min((firstRow + 1) * perInvocation, rows.count);
  for (int bandRow = firstRow * perInvocation; bandRow < endRow; bandRow += kBandRows) {
    // The row below the band, then the band's; those beyond the last are empty.
    Strip band[kBandRows + 1];
    float edgesY[kBandRows + 1];  // upper ones, on the light
    const int bandLow = cellBound(rows, bandRow);
    band[0] = rowOf(bandRow - 1, boundBelow(rows, bandRow, bandLow, cellBound(rows, bandRow + 1)), bandLow);
    edgesY[0] = scale.y * float(bandLow) + shift.y;
    for (int r = 1; r <= kBandRows; ++r) {
      band[r] = rowOf(bandRow + r - 1, band[r - 1].high, cellBound(rows, min(bandRow + r, endRow)));
      edgesY[r] = scale.y * float(band[r].high) + shift.y;
    }
    int nextColumn = columns.low;  // its lower bound
#if GAP_FILL != GAP_FILL_NONE
    // Of the column before: whether a cell blocks, and where its rectangle ends on the light.
    bool leftBlocks[kBandRows + 1];
    vec2 leftEnds[kBandRows + 1];
    const Strip before = columnOf(-1, boundBelow(columns, 0, columns.low, cellBound(columns, 1)), columns.low);
#if GAP_FILL == GAP_FILL_DIAGONAL
    for (int r = 0; r <= kBandRows; ++r) {
#else
    for (int r = 1; r <= kBandRows; ++r) {
#endif
      const CellDepth cell = cellDepth(before, band[r]);
      leftBlocks[r] = cellBlocks(cell, p, depth);
      leftEnds[r] = widenedScale(cell.z, p.z, largest) * vec2(scale.x * float(columns.low) + shift.x, edgesY[r]) + eyeOnLight;
    }
#endif
    for (int x = 0; x < columns.count; ++x) {
      const Strip column = columnOf(x, nextColumn, cellBound(columns, x + 1));
      nextColumn = column.high;
      const vec2 edgesX = scale.x * vec2(column.low, column.high) + shift.x;
#if GAP_FILL != GAP_FILL_NONE
      // The same of the cell below.
      const CellDepth lower = cellDepth(column, band[0]);
      bool lowerBlocks = cellBlocks(lower, p, depth);
      vec2 lowerEnd = widenedScale(lower.z, p.z, largest) * vec2(edgesX.y, edgesY[0]) + eyeOnLight;
#endif
      for (int r = 1; r <= kBandRows; ++r) {
        const CellDepth own = cellDepth(column, band[r]);
        if (bandRow + r <= endRow) ++examinedCount;
        const bool blocking = cellBlocks(own, p, depth);
        vec2 end = vec2(0.0);
        if (blocking) {
          const vec2 k = widenedScale(own.z, p.z, largest);
          vec2 start = k * vec2(edgesX.x, edgesY[r - 1]) + eyeOnLight;
          end = k * vec2(edgesX.y, edgesY[r]) + eyeOnLight;
#if GAP_FILL != GAP_FILL_NONE
          if (leftBlocks[r]) start.x = stretchedTo(start.x, leftEnds[r].x);
          if (lowerBlocks) start.y = stretchedTo(start.y, lowerEnd.y);
#endif
#if GAP_FILL == GAP_FILL_DIAGONAL
          if (leftBlocks[r - 1]) start = min(start, leftEnds[r - 1]);
#endif
          accumulateOnLight(start, end);
        }
#if GAP_FILL == GAP_FILL_DIAGONAL
        // The row above still needs its own of the column before, and this one's.
        leftBlocks[r - 1] = lowerBlocks;
        leftEnds[r - 1] = lowerEnd;
#elif GAP_FILL != GAP_FILL_NONE
        leftBlocks[r] = blocking;
        leftEnds[r] = end;
#endif
#if GAP_FILL != GAP_FILL_NONE
        lowerBlocks = blocking;
        lowerEnd = end;
#endif
      }
#if GAP_FILL == GAP_FILL_DIAGONAL
      leftBlocks[kBandRows] = lowerBlocks;
      leftEnds[kBandRows] = lowerEnd;
#endif
    }
    if (isSaturated()) return 0.0;
  }
  return gatheredVisibility();
}

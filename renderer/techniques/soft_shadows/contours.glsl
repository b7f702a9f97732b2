// SPDX-License-Identifier: BSD-3-Clause
// Contours around connected texels that block, instead of the texels themselves. A window of 2 x 2 texels slides over a
// level of the minimum pyramid; where some of its texels block and others do not it holds one or two pieces of contour,
// which are backprojected and gathered as signed areas. Schwarz 2009, section 4.4.5, on Guennebaud et al. 2007.
//
// The thesis gives neither the table of pieces nor how they are cut off at the light. Here a piece runs straight between two
// sides of the window, with the texels that block on its left; two that meet at a corner only get pieces of their own. Its
// ends lie at the depths of the blocking texels, `contourInset` of the way from the texel's border to its centre. The
// including shader takes pieces by accumulateEdge(from, to), in unit light coordinates.
uniform float contourInset;

void accumulateEdge(vec2 from, vec2 to);

// Windows between texels within the area, as the cells of microquads.
Range occluderRange(Area area, int level) {
  const int size = 1 << level;
  const ivec2 low = (2 * area.low + 1 - size) >> (level + 1), high = (2 * area.high - 2 - size) >> (level + 1);
  return Range(max(low, ivec2(0)), min(high, ivec2((resolution >> level) - 2)));
}

float gatherOccluders(vec4 p, Area area, int level) {
  const Range cells = occluderRange(area, level);
  const ivec2 low = cells.low, high = cells.high + 1;  // texels; beyond them nothing blocks, which closes all contours
  const float depth = biasedDepth(p, level);
  const vec2 perTexel = tangentSize / float(resolution) * float(1 << level);
  const vec2 scale = p.z * perTexel / lightSize;
  const vec2 shift = (p.z * tangentLow - p.xy) / lightSize;
  const ivec2 offsets[4] = ivec2[4](ivec2(0, 0), ivec2(1, 0), ivec2(1, 1), ivec2(0, 1));
  float depths[4] = float[4](kEmptyDepth, kEmptyDepth, kEmptyDepth, kEmptyDepth);
  int visited = 0;
  for (int y = low.y - 1 + firstRow; y <= high.y; y += rowStep) {
    depths[1] = depths[2] = kEmptyDepth;
    for (int x = low.x - 1; x <= high.x; ++x) {
      ++visited;
      depths[0] = depths[1];
      depths[3] = depths[2];
      depths[1] = depths[2] = kEmptyDepth;
      if (x < high.x) {
        if (y >= low.y) depths[1] = levelDepth(ivec2(x + 1, y), level);
        if (y < high.y) depths[2] = levelDepth(ivec2(x + 1, y + 1), level);
        fetchCount += 2u;
      }
      bvec4 blocking;
      for (int i = 0; i < 4; ++i) blocking[i] = blocks(depths[i], ivec2(x, y) + offsets[i], level, p, depth);
      // Windows without a blocking texel count as wasted work; the inside of a contour does not.
      ++examinedCount;
      if (any(blocking)) ++usedCount;
      if (all(blocking) || !any(blocking)) continue;
      for (int side = 0; side < 4; ++side) {
        // A piece begins between a texel that blocks and the next one round the window that does not, and ends before
        // the first one round the other way that does not.
        const int next = (side + 1) & 3;
        if (!blocking[side] || blocking[next]) continue;
        int last = side;
        if (blocking[(last + 3) & 3]) last = (last + 3) & 3;
        if (blocking[(last + 3) & 3]) last = (last + 3) & 3;
        const int before = (last + 3) & 3;
        const float outwards = 0.5 * (1.0 - contourInset);
        const vec2 fromTexel = vec2(x, y) + mix(vec2(offsets[side]), vec2(offsets[next]), outwards) + 0.5;
        const vec2 toTexel = vec2(x, y) + mix(vec2(offsets[last]), vec2(offsets[before]), outwards) + 0.5;
        ++occluderCount;
        accumulateEdge(projectionScale(depths[side], p.z) * (scale * fromTexel + shift) + 0.5,
                       projectionScale(depths[last], p.z) * (scale * toTexel + shift) + 0.5);
      }
    }
  }
  // A driver that grants a limited number of iterations has left the loops early.
  const ivec2 windows = high - low + 2;
  if (visited < windows.x * rowsToGather(windows.y)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  return gatheredVisibility();
}

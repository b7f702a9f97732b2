// SPDX-License-Identifier: BSD-3-Clause
// Texels of a level of the minimum pyramid as rectangles at one depth, backprojected onto the light. Schwarz 2009, section
// 4.1. The including shader gathers: accumulate(low, high) takes a rectangle in unit light coordinates.
//
// In tangents t = x/z the backprojection of a texel edge at depth z from receiver p is, in unit light coordinates,
//   s = z / (p_z - z) * (p_z t - p_x) / w + e,
// e being the map's eye in these coordinates, to which p is relative; 1/2 in the light's centre.

Range occluderRange(Area area, int level) { return Range(area.low >> level, (area.high - 1) >> level); }

#ifdef SEARCH_CELLS
#include "renderer/techniques/soft_shadows/search_cells.glsl"
#else
// Visibility by the micropatches of a level that lie in the area.
float gatherOccluders(vec4 p, Area area, int level) {
  const Range range = occluderRange(area, level);
  const ivec2 low = range.low, high = range.high;
  const ivec2 count = high - low + 1;
  if (float(count.x + 1) * float(count.y) > float(maxIterations)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  const float depth = biasedDepth(p, level);
  const vec2 perTexel = tangentSize / float(resolution) * float(1 << level);
  // Unit light coordinates of edge e (in texels of the level) thrown by k: k (scale e + shift) + eyeOnLight.
  const vec2 scale = p.z * perTexel / lightSize;
  const vec2 shift = (p.z * tangentLow - p.xy) / lightSize;
  for (int y = low.y + firstRow; y <= high.y; y += rowStep) {
    const vec2 edgesY = scale.y * vec2(float(y), float(y + 1)) + shift.y;
#if GAP_FILL != GAP_FILL_NONE
    float left = low.x > 0 ? levelDepth(ivec2(low.x - 1, y), level) : kEmptyDepth;
    bool leftBlocks = blocks(left, ivec2(low.x - 1, y), level, p, depth);
    float lowerLeft = low.x > 0 && y > 0 ? levelDepth(ivec2(low.x - 1, y - 1), level) : kEmptyDepth;
#endif
    for (int x = low.x; x <= high.x; ++x) {
      const float z = levelDepth(ivec2(x, y), level);
      ++fetchCount;
      ++examinedCount;
#if GAP_FILL != GAP_FILL_NONE
      const float below = y > 0 ? levelDepth(ivec2(x, y - 1), level) : kEmptyDepth;
      ++fetchCount;
#endif
      const bool blocking = blocks(z, ivec2(x, y), level, p, depth);
      if (blocking) {
        const vec2 edgesX = scale.x * vec2(float(x), float(x + 1)) + shift.x;
        const float k = projectionScale(z, p.z);
        vec2 start = k * vec2(edgesX.x, edgesY.x) + eyeOnLight;
        const vec2 end = k * vec2(edgesX.y, edgesY.y) + eyeOnLight;
#if GAP_FILL != GAP_FILL_NONE
        if (leftBlocks)
          start.x = stretchedTo(start.x, projectionScale(left, p.z) * edgesX.x + eyeOnLight.x);
        if (blocks(below, ivec2(x, y - 1), level, p, depth))
          start.y = stretchedTo(start.y, projectionScale(below, p.z) * edgesY.x + eyeOnLight.y);
#endif
#if GAP_FILL == GAP_FILL_DIAGONAL
        if (blocks(lowerLeft, ivec2(x - 1, y - 1), level, p, depth)) {
          const float corner = projectionScale(lowerLeft, p.z);
          start = min(start, corner * vec2(edgesX.x, edgesY.x) + eyeOnLight);
        }
#endif
        accumulateOnLight(start, end);
      }
#if GAP_FILL != GAP_FILL_NONE
      left = z;
      leftBlocks = blocking;
      lowerLeft = below;
#endif
    }
    if (isSaturated()) return 0.0;
  }
  return gatheredVisibility();
}
#endif

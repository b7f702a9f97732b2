// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/shadow_lookup.glsl"
#define STRUCTURE_HSM
#include "renderer/techniques/soft_shadows/depth_bounds.glsl"
#include "renderer/techniques/soft_shadows/plane_share.glsl"
#include "renderer/techniques/soft_shadows/texel_test.glsl"
// Layers behind the first, which is the finest level of `minimumMap`. One sampler each: llvmpipe reads arrays of samplers
// wrongly where the index is computed.
#if LAYERS > 1
layout(binding = kSecondLayerUnit) uniform sampler2D secondLayer;
#endif
#if LAYERS > 2
layout(binding = kThirdLayerUnit) uniform sampler2D thirdLayer;
#endif
#if LAYERS > 3
layout(binding = kFourthLayerUnit) uniform sampler2D fourthLayer;
#endif

uniform int levels, refinements, maxIterations;
#ifdef SEARCH_CELLS
uniform int allowedPerAxis;  // cells of a budget; 16384: no limit
uniform float leastWidth;    // of the light as projected onto the map, in texels
#include "renderer/techniques/soft_shadows/cell_grid.glsl"
#endif

// Depth of the farthest layer that blocks; kEmptyDepth if none does.
float farthestBefore(ivec2 texel, vec4 p, float depth) {
  float z = texelFetch(minimumMap, texel, 0).x;
  ++fetchCount;
  if (!texelBlocks(z, texel, p, depth)) return kEmptyDepth;
#if LAYERS > 1
  float next = texelFetch(secondLayer, texel, 0).x;
  ++fetchCount;
  if (!texelBlocks(next, texel, p, depth)) return z;
  z = next;
#endif
#if LAYERS > 2
  next = texelFetch(thirdLayer, texel, 0).x;
  ++fetchCount;
  if (!texelBlocks(next, texel, p, depth)) return z;
  z = next;
#endif
#if LAYERS > 3
  next = texelFetch(fourthLayer, texel, 0).x;
  ++fetchCount;
  if (!texelBlocks(next, texel, p, depth)) return z;
  z = next;
#endif
  return z;
}

// Area that texels [low, high) hide, seen as one surface at depth z. `largest`: no wider than this on the light.
float hiddenArea(vec4 p, vec2 low, vec2 high, float z, vec2 largest) {
  ++occluderCount;
  const vec2 centre = p.xy / p.z, perTexel = tangentSize / float(resolution);
  const vec2 thrown = min(vec2(z / (p.z - z)), largest) * p.z / lightSize;
  const vec2 start = thrown * (tangentLow + low * perTexel - centre) + 0.5, end = thrown * (tangentLow + high * perTexel - centre) + 0.5;
  // In an order that turns a NaN into a bound.
  const vec2 a = min(max(start, vec2(0.0)), vec2(1.0)), b = min(max(end, vec2(0.0)), vec2(1.0));
  if (!(a.x < b.x && a.y < b.y)) return 0.0;
  ++usedCount;
  return (b.x - a.x) * (b.y - a.y);
}

float visibilityOf(vec4 p, ivec2 pixel) {
  const float depth = biasedDepth(p, 0);
  const vec2 centre = p.xy / p.z;
  float nearest = max(near, texelFetch(minimumMap, ivec2(0), levels - 1).x);
  pixelClass = kLit;
  fetchCount = 1u;
  const float frontShare = shareBeforePlane(p);
  if (nearest >= depth) return frontShare;
  Area area;
  for (int i = 0;; ++i) {
#ifdef SEARCH_CELLS
    const vec2 perLength = max(vec2(1.0 / nearest - 1.0 / p.z), leastWidth * tangentSize / (float(resolution) * lightSize));
#else
    const float perLength = max(1.0 / nearest - 1.0 / p.z, 0.0);
#endif
    const vec2 reach = 0.5 * lightSize * perLength, limit = vec2(float(resolution));
    const vec2 low = floor(mapTexel(centre - reach)), high = ceil(mapTexel(centre + reach));
    area = Area(ivec2(clamp(low, vec2(0.0), limit)), ivec2(clamp(high, vec2(0.0), limit)));
    if (any(greaterThanEqual(area.low, area.high))) {
      if (any(lessThan(low, vec2(0.0))) || any(greaterThan(high, limit))) pixelClass = kOutside;
      return frontShare;
    }
    if (i >= refinements) break;
    const float found = depthRange(area, false).x;
    if (found >= depth) return frontShare;
    if (found <= nearest) break;
    nearest = found;
  }
  fetchCount += boundFetches;
  pixelClass = kProcessed;
#ifdef SEARCH_CELLS
  const Cells columns = cellsAlong(area.low.x, area.high.x), rows = cellsAlong(area.low.y, area.high.y);
  const ivec2 count = ivec2(columns.count, rows.count);
#else
  const ivec2 count = area.high - area.low;
#endif
  areaTexels = uint(area.high.x - area.low.x) * uint(area.high.y - area.low.y);
  if (float(count.x + 1) * float(count.y) > float(maxIterations)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  float hidden = 0.0;
#ifdef SEARCH_CELLS
  receiverTexel = ivec2(floor(mapTexel(centre)));
  const vec2 largest = lightSize * float(resolution) / (p.z * tangentSize * leastWidth);
#endif
  for (int y = 0; y < count.y; ++y)
    for (int x = 0; x < count.x; ++x) {
      ++examinedCount;
#ifdef SEARCH_CELLS
      const ivec2 low = ivec2(cellBound(columns, x), cellBound(rows, y)), high = ivec2(cellBound(columns, x + 1), cellBound(rows, y + 1));
      const float z = farthestBefore(cellTexel(columnOf(x, low.x, high.x), rowOf(y, low.y, high.y)), p, depth);
      if (z < depth) hidden += hiddenArea(p, vec2(low), vec2(high), z, largest);
#else
      const ivec2 texel = area.low + ivec2(x, y);
      const float z = farthestBefore(texel, p, depth);
      if (z < depth) hidden += hiddenArea(p, vec2(texel), vec2(texel + 1), z, vec2(uintBitsToFloat(0x7f800000u)));
#endif
    }
  // As in backprojection: areas cannot tell whether an occluder and the plane hide the same part.
  return frontShare * (1.0 - min(hidden, 1.0));
}

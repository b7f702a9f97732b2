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
    const vec2 reach = 0.5 * lightSize * max(1.0 / nearest - 1.0 / p.z, 0.0), limit = vec2(float(resolution));
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
  const ivec2 count = area.high - area.low;
  areaTexels = uint(count.x) * uint(count.y);
  if (float(count.x + 1) * float(count.y) > float(maxIterations)) {
    pixelClass = kCutShort;
    return uintBitsToFloat(0x7fc00000u);  // no number rather than a wrong one
  }
  const vec2 perTexel = tangentSize / float(resolution);
  float hidden = 0.0;
  for (int y = area.low.y; y < area.high.y; ++y)
    for (int x = area.low.x; x < area.high.x; ++x) {
      ++examinedCount;
      const float z = farthestBefore(ivec2(x, y), p, depth);
      if (!(z < depth)) continue;
      ++occluderCount;
      const vec2 low = tangentLow + vec2(x, y) * perTexel;
      const vec2 thrown = z / (p.z - z) * p.z / lightSize;
      const vec2 start = thrown * (low - centre) + 0.5, end = thrown * (low + perTexel - centre) + 0.5;
      // In an order that turns a NaN into a bound.
      const vec2 a = min(max(start, vec2(0.0)), vec2(1.0)), b = min(max(end, vec2(0.0)), vec2(1.0));
      if (!(a.x < b.x && a.y < b.y)) continue;
      ++usedCount;
      hidden += (b.x - a.x) * (b.y - a.y);
    }
  // As in backprojection: areas cannot tell whether an occluder and the plane hide the same part.
  return frontShare * (1.0 - min(hidden, 1.0));
}

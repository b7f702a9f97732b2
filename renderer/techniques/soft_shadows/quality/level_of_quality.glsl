// SPDX-License-Identifier: BSD-3-Clause
// Level of the pyramid from which a pixel's micro-occluders come, by what it may spend. Schwarz 2009, section 5.2.1; the
// formulas are reconstructed from there.
// LEVELS: see LevelRule in level_settings.h; narrow_blend blends over `blendWidth` levels about the middle.
// FILTERED_LEVEL: the real level follows from linearly filtered depths, after Guennebaud et al. 2007 (section 5.2).
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

uniform int budgetPerAxis;  // micro-occluders; 16384: no limit
#ifdef BUDGET_MAP
layout(binding = kBudgetMapUnit) uniform sampler2D budgetMap;  // micro-occluders, not their root; 0: no limit
#endif
uniform float blendWidth;

#if LEVELS == LEVELS_FINEST_WITHIN || LEVELS == LEVELS_COARSEST_OVER
#define ONE_LEVEL  // a pixel has one whole level
#endif

// What this pixel may spend.
int allowedPerAxis = 1;

void readBudget(ivec2 pixel) {
  allowedPerAxis = budgetPerAxis;
#ifdef BUDGET_MAP
  const float budget = texelFetch(budgetMap, pixel, 0).x;
  // Not floor(sqrt()), since the root of a square may come out a little too small.
  float root = floor(sqrt(budget) + 0.5);
  if (root * root > budget) root -= 1.0;
  allowedPerAxis = budget > 0.0 ? int(clamp(root, 1.0, 16384.0)) : 16384;
#endif
}

// Finest level at which the area's micro-occluders keep within the budget on both axes.
int finestLevelWithin(Area area) {
  if (fixedLevel >= 0) return min(fixedLevel, levels - 1);
  int level = 0;
  while (level < levels - 1) {
    const Range range = occluderRange(area, level);
    const ivec2 count = range.high - range.low + 1;
    if (max(count.x, count.y) <= allowedPerAxis) break;
    ++level;
  }
  return level;
}

// Real level at which an extent, in texels, has as many texels as are allowed. Logarithms of powers of two may miss whole
// numbers by a little, and a second level for nothing would follow.
float levelOfExtent(float extent) {
  const float level = clamp(log2(max(extent, 1.0) / float(allowedPerAxis)), 0.0, float(levels - 1));
  const float whole = floor(level + 0.5);
  return abs(level - whole) < 1e-5 ? whole : level;
}

float levelOfArea(Area area) {
#if LEVELS == LEVELS_FINEST_WITHIN
  return float(finestLevelWithin(area));
#else
  const ivec2 extent = area.high - area.low;
  const float level = levelOfExtent(float(max(extent.x, extent.y)));
#if LEVELS == LEVELS_COARSEST_OVER
  return floor(level);
#else
  return level;
#endif
#endif
}

#ifdef FILTERED_LEVEL
// The nearest occluder's depth as it varies without steps from pixel to pixel, as long as neighbours read one level of the
// pyramid: the one at which 2 x 2 texels hold the area. What does not lie before the receiver is put at its depth, since
// empty texels are infinitely far.
float filteredLevel(vec4 p, Area area) {
  const ivec2 last = area.high - 1;
  const int extent = max(last.x - area.low.x, last.y - area.low.y);
  int level = extent > 0 ? findMSB(extent) : 0;
  if (any(greaterThan((last >> level) - (area.low >> level), ivec2(1)))) ++level;
  const int size = resolution >> level;
  const vec2 at = mapTexel(p.xy / p.z) / float(1 << level) - 0.5;
  const ivec2 low = ivec2(floor(at));
  float z[4];
  for (int i = 0; i < 4; ++i) {
    const ivec2 texel = clamp(low + ivec2(i & 1, i >> 1), ivec2(0), ivec2(size - 1));
    z[i] = min(minimumDepth(texel, level), p.z);
  }
  fetchCount += 4u;
  const vec2 part = at - vec2(low);
  const float nearest = mix(mix(z[0], z[1], part.x), mix(z[2], z[3], part.x), part.y);
  const vec2 extents = lightSize * max(1.0 / nearest - 1.0 / p.z, 0.0) / tangentSize * float(resolution);
  const float found = levelOfExtent(max(extents.x, extents.y));
#if LEVELS == LEVELS_COARSEST_OVER
  return floor(found);
#else
  return found;
#endif
}
#endif

// Level for a receiver whose search area has been narrowed.
float qualityLevel(vec4 p, Area area) {
#if defined(SEARCH_CELLS)
  return 0.0;  // cells are made of the map's own texels
#elif defined(FILTERED_LEVEL)
  return filteredLevel(p, area);
#else
  return levelOfArea(area);
#endif
}

#if LEVELS == LEVELS_DITHER
#include "renderer/techniques/soft_shadows/quality/dither.glsl"
#endif

// Weight of the coarser of the two levels around a real one whose fraction is given.
float coarserWeight(float fraction, ivec2 pixel) {
#if LEVELS == LEVELS_NARROW_BLEND
  return clamp((fraction - 0.5 + 0.5 * blendWidth) / blendWidth, 0.0, 1.0);
#elif LEVELS == LEVELS_DITHER
  return fraction > ditherThreshold(pixel) ? 1.0 : 0.0;
#else
  return fraction;
#endif
}

// Iterations of the loop over a level's occluders, with those that only close its rows.
float iterationsOf(Area area, int level) {
  const Range range = occluderRange(area, level);
  const vec2 count = vec2(max(range.high - range.low + 1, ivec2(0)));
  return (count.x + 1.0) * count.y;
}

#ifdef ONE_LEVEL
#define LEVELS_PER_PIXEL 1
#else
#define LEVELS_PER_PIXEL 2
#endif

// The levels that a real level stands for, `first` to `last`, and the weight of the last of two. Both are rounded outward
// from the one search area. Begins the processing of a pixel; false: more iterations than the driver allows.
bool beginLevels(Area area, float level, ivec2 pixel, out int first, out int last, out float weight) {
  pixelClass = kProcessed;
  areaTexels = uint(area.high.x - area.low.x) * uint(area.high.y - area.low.y);
  levelUsed = level;
  first = last = int(level);
  weight = 0.0;
#ifndef ONE_LEVEL
  const int finer = first;
  weight = coarserWeight(level - float(finer), pixel);
  first = weight < 1.0 ? finer : finer + 1;
  last = weight > 0.0 ? finer + 1 : finer;
  if (first < last && iterationsOf(area, first) + iterationsOf(area, last) > float(maxIterations)) {
    pixelClass = kCutShort;
    return false;
  }
#endif
  return true;
}

#if LANES <= 1
float visibilityAt(vec4 p, Area area, float level, ivec2 pixel) {
  int first, last;
  float weight, visibility = 0.0;
  // No number rather than a wrong one.
  if (!beginLevels(area, level, pixel, first, last, weight)) return uintBitsToFloat(0x7fc00000u);
#ifdef ONE_LEVEL
  clearGathered();
  hideBehindPlane(p);
  visibility = gatherOccluders(p, area, first);
#else
  for (int i = first; i <= last; ++i) {
    clearGathered();
    hideBehindPlane(p);
    const float found = gatherOccluders(p, area, i);
    visibility = i == first ? found : mix(visibility, found, weight);
  }
#endif
  return visibility;
}
#endif

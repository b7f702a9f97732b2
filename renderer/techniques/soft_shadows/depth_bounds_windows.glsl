// SPDX-License-Identifier: BSD-3-Clause
// Depth range of an area by squares of a power of two that lie anywhere: multi-scale shadow map (MSSM) or N-buffer, see
// renderer/frame/multi_scale_map.h. Schwarz 2009, section 4.3.1; where the squares lie is reconstructed from there.
// CORNER: windows are stored at their lower corner (N-buffer) and not at their centre.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

layout(binding = kMultiScaleMapUnit) uniform sampler2DArray multiScaleMap;  // its layer i is the structure's layer i + 1
#if MAP_LAYERS > 1
uniform int structureLayers;  // of each layer of the map
#endif
uniform int baseLevel;                                     // level of the pyramid that is layer 0

// Depth range of the square of 2^layer texels from `start` on, which may begin or end outside of the map.
vec2 windowRange(ivec2 start, int layer) {
#ifdef CORNER
  const ivec2 at = max(start, ivec2(0));
#else
  const ivec2 at = start + ((1 << layer) >> 1);
#endif
  ++boundFetches;
#if MAP_LAYERS > 1
  if (layer > 0) return texelFetch(multiScaleMap, ivec3(at, mapLayer * structureLayers + layer - 1), 0).xy;
#else
  if (layer > 0) return texelFetch(multiScaleMap, ivec3(at, layer - 1), 0).xy;
#endif
  const float low = minimumDepth(at, baseLevel);
  if (baseLevel == 0) return vec2(low);
  ++boundFetches;
  return vec2(low, maximumDepth(at, baseLevel - 1));
}

vec2 combine(vec2 a, vec2 b) { return vec2(min(a.x, b.x), max(a.y, b.y)); }

// Range over an area, in texels of layer 0: by the smallest square that covers it, put at its middle, or by four of half
// that size, flush with its corners. An axis that is shorter than these gets one of them in its middle.
vec2 squaresRange(Area area, bool single) {
  const ivec2 extent = area.high - area.low;
  const int longest = max(extent.x, extent.y);
  const int cover = longest > 1 ? findMSB(longest - 1) + 1 : 0;
  const int layer = single ? cover : max(cover - 1, 0);
  const ivec2 size = ivec2(1 << layer);
  const ivec2 first = area.low - (max(size - extent, ivec2(0)) + 1) / 2, second = max(area.high - size, first);
  vec2 range = windowRange(first, layer);
  if (second.x > first.x) range = combine(range, windowRange(ivec2(second.x, first.y), layer));
  if (second.y > first.y) range = combine(range, windowRange(ivec2(first.x, second.y), layer));
  if (second.x > first.x && second.y > first.y) range = combine(range, windowRange(second, layer));
  return range;
}

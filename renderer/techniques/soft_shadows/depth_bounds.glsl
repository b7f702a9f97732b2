// SPDX-License-Identifier: BSD-3-Clause
// Smallest and largest depth over an area of the shadow map, conservatively, by the acceleration structure that the host
// chose (occluder_search.cpp). Schwarz 2009, section 4.3.
#include "renderer/techniques/soft_shadows/shadow_bindings.h"
#include "renderer/frame/shadow_depth.glsl"
// Level 0 of the minimum: the linear shadow map. Level i of the maximum is the pyramid's level i + 1.
#if MAP_LAYERS > 1
layout(binding = kMinimumMapUnit) uniform sampler2DArray minimumMap;
layout(binding = kMaximumMapUnit) uniform sampler2DArray maximumMap;
float minimumDepth(ivec2 texel, int level) { return texelFetch(minimumMap, ivec3(texel, mapLayer), level).x; }
float maximumDepth(ivec2 texel, int level) { return texelFetch(maximumMap, ivec3(texel, mapLayer), level).x; }
#else
layout(binding = kMinimumMapUnit) uniform sampler2D minimumMap;
layout(binding = kMaximumMapUnit) uniform sampler2D maximumMap;
float minimumDepth(ivec2 texel, int level) { return texelFetch(minimumMap, texel, level).x; }
float maximumDepth(ivec2 texel, int level) { return texelFetch(maximumMap, texel, level).x; }
#endif

// Texels [low, high) of level 0.
struct Area {
  ivec2 low, high;
};

uint boundFetches = 0u;  // texels read; one of two channels counts once

#include "renderer/techniques/soft_shadows/depth_bounds_hsm.glsl"
#include "renderer/techniques/soft_shadows/depth_bounds_windows.glsl"

// `rough`: one square will do, where the structure has squares.
#if defined(STRUCTURE_NONE)
vec2 depthRange(Area area, bool rough) { return vec2(-kEmptyDepth, kEmptyDepth); }
#elif defined(STRUCTURE_HSM)
vec2 depthRange(Area area, bool rough) { return tileRange(area); }
#elif defined(STRUCTURE_WINDOWS)
vec2 depthRange(Area area, bool rough) { return squaresRange(area, rough); }
#elif defined(STRUCTURE_YSM)
// Small areas by the pyramid, whose tiles are no larger than the layers' texels there; large ones by the layers.
vec2 depthRange(Area area, bool rough) {
  const ivec2 extent = area.high - area.low;
  if (max(extent.x, extent.y) <= 1 << baseLevel) return tileRange(area);
  return squaresRange(Area(area.low >> baseLevel, ((area.high - 1) >> baseLevel) + 1), rough);
}
#endif

// SPDX-License-Identifier: BSD-3-Clause
// One layer of the multi-scale map (or N-buffer) from the layer below: each window of 2^i x 2^i texels is
// made of four of half its size. A window past the border is the one at the border, which lies within the
// window that is asked for.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kGroupSide, local_size_y = kGroupSide) in;
#ifdef FROM_PYRAMID
layout(binding = kMultiScaleMinimumMapUnit) uniform sampler2D minimumMap;
layout(binding = kMultiScaleMaximumMapUnit) uniform sampler2D maximumMap;  // its level i is the pyramid's level i + 1
uniform int sourceLevel;
#else
layout(binding = kMultiScaleLayersUnit) uniform sampler2DArray layers;
#endif
layout(binding = kMultiScaleImage, rg32f) uniform writeonly image2DArray outLayers;
uniform int layer, resolution;
uniform ivec2 offsets;  // of the lower and the upper half, along both axes

vec2 below(int x, int y) {
  const ivec2 at = clamp(ivec2(gl_GlobalInvocationID.xy) + ivec2(x, y), ivec2(0), ivec2(resolution - 1));
#ifdef FROM_PYRAMID
  const float low = texelFetch(minimumMap, at, sourceLevel).x;
  return vec2(low, sourceLevel == 0 ? low : texelFetch(maximumMap, at, sourceLevel - 1).x);
#else
  return texelFetch(layers, ivec3(at, layer - 2), 0).xy;
#endif
}

vec2 combine(vec2 a, vec2 b) { return vec2(min(a.x, b.x), max(a.y, b.y)); }

void main() {
  if (any(greaterThanEqual(ivec2(gl_GlobalInvocationID.xy), ivec2(resolution)))) return;
  const vec2 range = combine(combine(below(offsets.x, offsets.x), below(offsets.y, offsets.x)),
                             combine(below(offsets.x, offsets.y), below(offsets.y, offsets.y)));
  imageStore(outLayers, ivec3(gl_GlobalInvocationID.xy, layer - 1), vec4(range, 0.0, 0.0));
}

// SPDX-License-Identifier: BSD-3-Clause
// All layers of a small multi-scale map (or N-buffer), along one axis at a time: a window of 2^i x 2^i texels is made of windows of
// 2^i x 1. ROWS: a group makes those of all layers in one row of the map. Otherwise: a group makes the windows of one layer in
// kMultiScaleColumns columns, from the rows' in the same layer.
// Windows past the border are those at the border, as in multi_scale_map.comp.glsl.
#include "renderer/frame/frame_bindings.h"

layout(binding = kMultiScaleImage, rg32f) uniform writeonly image2DArray outLayers;
uniform int resolution, layerCount;
uniform ivec2 offsets[kMultiScaleLineLayers];  // of the two halves of a layer's window in the layer below

vec2 combine(vec2 a, vec2 b) { return vec2(min(a.x, b.x), max(a.y, b.y)); }
ivec2 halves(int at, int layer) { return clamp(at + offsets[layer], ivec2(0), ivec2(resolution - 1)); }

#ifdef ROWS
layout(local_size_x = kMultiScaleLine) in;
layout(binding = kMultiScaleMinimumMapUnit) uniform sampler2D minimumMap;
layout(binding = kMultiScaleMaximumMapUnit) uniform sampler2D maximumMap;  // its level i is the pyramid's level i + 1
uniform int sourceLevel;
shared vec2 windows[2][kMultiScaleLine];

void main() {
  const ivec2 at = ivec2(gl_LocalInvocationID.x, gl_WorkGroupID.x);
  const bool inside = at.x < resolution;
  if (inside) {
    const float low = texelFetch(minimumMap, at, sourceLevel).x;
    windows[0][at.x] = vec2(low, sourceLevel == 0 ? low : texelFetch(maximumMap, at, sourceLevel - 1).x);
  }
  for (int layer = 0; layer < layerCount; ++layer) {
    barrier();
    if (!inside) continue;
    const ivec2 from = halves(at.x, layer);
    const vec2 window = combine(windows[layer & 1][from.x], windows[layer & 1][from.y]);
    windows[1 - (layer & 1)][at.x] = window;
    imageStore(outLayers, ivec3(at, layer), vec4(window, 0.0, 0.0));
  }
}
#else
const int kRowsAtOnce = kMultiScaleLine / kMultiScaleColumns;
layout(local_size_x = kMultiScaleColumns, local_size_y = kRowsAtOnce) in;
layout(binding = kMultiScaleLayersUnit) uniform sampler2DArray layers;
shared vec2 windows[2][kMultiScaleLine][kMultiScaleColumns];

void main() {
  const int layer = int(gl_WorkGroupID.y), column = int(gl_LocalInvocationID.x), first = int(gl_LocalInvocationID.y);
  const int x = int(gl_WorkGroupID.x) * kMultiScaleColumns + column;
  const bool inside = x < resolution;
  for (int y = first; inside && y < resolution; y += kRowsAtOnce)
    windows[0][y][column] = texelFetch(layers, ivec3(x, y, layer), 0).xy;
  for (int below = 0; below <= layer; ++below) {
    barrier();
    for (int y = first; inside && y < resolution; y += kRowsAtOnce) {
      const ivec2 from = halves(y, below);
      const vec2 window = combine(windows[below & 1][from.x][column], windows[below & 1][from.y][column]);
      if (below < layer)
        windows[1 - (below & 1)][y][column] = window;
      else
        imageStore(outLayers, ivec3(x, y, layer), vec4(window, 0.0, 0.0));
    }
  }
}
#endif

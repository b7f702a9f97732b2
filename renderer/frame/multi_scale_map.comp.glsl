// SPDX-License-Identifier: BSD-3-Clause
// Several layers of the multi-scale map (or N-buffer) from the layer below them: each window of 2^i x 2^i texels is made of four
// of half its size. Windows of these layers are shifted by multiples of `stride` against each other, so that entries at the same
// place within squares of that side make a grid of their own. A group makes a tile of one such grid, with the entries around it
// that the tile's last layer is made from.
//
// A window past the grid's border is the one at the border: it lies within the window that is asked for, and with the other half
// it covers all of that window within the map, since no place within a square is farther from the map's border than half a window
// of the layer below.
#include "renderer/frame/frame_bindings.h"

layout(local_size_x = kMultiScaleTile, local_size_y = kMultiScaleTile) in;
#ifdef FROM_PYRAMID
layout(binding = kMultiScaleMinimumMapUnit) uniform sampler2D minimumMap;
layout(binding = kMultiScaleMaximumMapUnit) uniform sampler2D maximumMap;  // its level i is the pyramid's level i + 1
uniform int sourceLevel;
#else
layout(binding = kMultiScaleLayersUnit) uniform sampler2DArray layers;
#endif
layout(binding = kMultiScaleImage, rg32f) uniform writeonly image2DArray outLayers;
uniform int firstLayer, layersMade, resolution, stride;
uniform ivec2 offsets[kMultiScaleLayers];  // of the lower and the upper half, along both axes, for each layer; in strides
uniform ivec2 reach;  // entries needed beyond a tile's low and its high side

// The reach is at most 2^kMultiScaleLayers - 1 on either side. Each invocation has one entry in every block of a tile's size.
const int kMostSide = kMultiScaleTile + 2 * ((1 << kMultiScaleLayers) - 1);
const int kBlocks = (kMostSide + kMultiScaleTile - 1) / kMultiScaleTile;
shared vec2 below[kMostSide][kMostSide];

vec2 combine(vec2 a, vec2 b) { return vec2(min(a.x, b.x), max(a.y, b.y)); }

vec2 sourceRange(ivec2 texel) {
#ifdef FROM_PYRAMID
  const float low = texelFetch(minimumMap, texel, sourceLevel).x;
  return vec2(low, sourceLevel == 0 ? low : texelFetch(maximumMap, texel, sourceLevel - 1).x);
#else
  return texelFetch(layers, ivec3(texel, firstLayer - 2), 0).xy;
#endif
}

void main() {
  const ivec2 group = ivec2(gl_WorkGroupID.xy), within = group % stride, own = ivec2(gl_LocalInvocationID.xy);
  const ivec2 tile = group / stride * kMultiScaleTile;
  const ivec2 low = max(tile - reach.x, ivec2(0));
  const ivec2 size = min(tile + kMultiScaleTile + reach.y, ivec2(resolution / stride)) - low;
  for (int block = 0; block < kBlocks * kBlocks; ++block) {
    const ivec2 at = own + kMultiScaleTile * ivec2(block % kBlocks, block / kBlocks);
    if (all(lessThan(at, size))) below[at.y][at.x] = sourceRange((low + at) * stride + within);
  }
  for (int layer = 0; layer < layersMade; ++layer) {
    barrier();
    vec2 made[kBlocks * kBlocks];
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
      const ivec2 at = own + kMultiScaleTile * ivec2(block % kBlocks, block / kBlocks);
      if (any(greaterThanEqual(at, size))) continue;
      const ivec2 first = clamp(at + offsets[layer].x, ivec2(0), size - 1);
      const ivec2 second = clamp(at + offsets[layer].y, ivec2(0), size - 1);
      made[block] = combine(combine(below[first.y][first.x], below[first.y][second.x]),
                            combine(below[second.y][first.x], below[second.y][second.x]));
      const ivec2 inTile = low + at - tile;
      if (all(greaterThanEqual(inTile, ivec2(0))) && all(lessThan(inTile, ivec2(kMultiScaleTile))))
        imageStore(outLayers, ivec3((low + at) * stride + within, firstLayer + layer - 1), vec4(made[block], 0.0, 0.0));
    }
    barrier();
    for (int block = 0; block < kBlocks * kBlocks; ++block) {
      const ivec2 at = own + kMultiScaleTile * ivec2(block % kBlocks, block / kBlocks);
      if (all(lessThan(at, size))) below[at.y][at.x] = made[block];
    }
  }
}

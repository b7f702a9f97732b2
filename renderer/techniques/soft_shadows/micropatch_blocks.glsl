// SPDX-License-Identifier: BSD-3-Clause
// Micropatches (micropatches.glsl) where LANES invocations share a pixel. The range of texels is cut into blocks of 2 x 2,
// which are dealt out one after another. Each invocation first looks which of the texels of several blocks block, and then
// throws these only, so that those that run side by side seldom wait for one another; masks and areas are those of the rows.

Range occluderRange(Area area, int level) { return Range(area.low >> level, (area.high - 1) >> level); }

const int kBlocksAtOnce = 8;  // 32 texels: a bit each
const ivec2 kBlockPlaces[4] = ivec2[4](ivec2(0, 0), ivec2(1, 0), ivec2(0, 1), ivec2(1, 1));

// Depths of 2 x 2 texels from `low` on, in the order of kBlockPlaces. Of texels outside of the level: any.
vec4 blockDepths(ivec2 low, int level) {
  fetchCount += 4u;
#ifdef DEPTHS_SAMPLED
  // Between texels, where it is clear which four are meant.
  if (level == 0) return textureGather(minimumMap, vec2(low + 1) / float(resolution)).wzxy;
  const vec2 atlasSize = vec2(resolution / 2, resolution);
  return textureGather(sampledDepths, vec2(sampledPlace(low, level, resolution) + 1) / atlasSize).wzxy;
#else
  vec4 depths;
  for (int i = 0; i < 4; ++i) depths[i] = levelDepth(clamp(low + kBlockPlaces[i], ivec2(0), ivec2((resolution >> level) - 1)), level);
  return depths;
#endif
}

// The low corners of blocks by their number.
struct Blocks {
  ivec2 low;  // of the first, even
  int columns, count;
};
ivec2 blockLow(Blocks blocks, int block) {
  int row = int((float(block) + 0.5) / float(blocks.columns)), column = block - row * blocks.columns;
  // Rounded for maps of any size.
  if (column < 0) column += blocks.columns, --row;
  if (column >= blocks.columns) column -= blocks.columns, ++row;
  return blocks.low + 2 * ivec2(column, row);
}

// How a texel's edges are thrown onto the light: unit light coordinates of edge e are k (scale e + shift) + eyeOnLight.
struct Throw {
  vec2 scale, shift;
};

void throwPatch(ivec2 texel, int level, vec4 p, float depth, Throw to) {
#if GAP_FILL == GAP_FILL_NONE
  const float z = levelDepth(texel, level);
  ++fetchCount;
#else
  const vec4 around = blockDepths(texel - 1, level);
  const float z = around[3];
#endif
  const vec2 low = to.scale * vec2(texel) + to.shift, high = to.scale * vec2(texel + 1) + to.shift;
  const float k = projectionScale(z, p.z);
  vec2 start = k * low + eyeOnLight;
  const vec2 end = k * high + eyeOnLight;
#if GAP_FILL != GAP_FILL_NONE
  const float left = texel.x > 0 ? around[2] : kEmptyDepth, below = texel.y > 0 ? around[1] : kEmptyDepth;
  if (blocks(left, texel - ivec2(1, 0), level, p, depth))
    start.x = min(start.x, projectionScale(left, p.z) * low.x + eyeOnLight.x);
  if (blocks(below, texel - ivec2(0, 1), level, p, depth))
    start.y = min(start.y, projectionScale(below, p.z) * low.y + eyeOnLight.y);
#endif
#if GAP_FILL == GAP_FILL_DIAGONAL
  const float lowerLeft = all(greaterThan(texel, ivec2(0))) ? around[0] : kEmptyDepth;
  if (blocks(lowerLeft, texel - 1, level, p, depth))
    start = min(start, projectionScale(lowerLeft, p.z) * low + eyeOnLight);
#endif
  accumulateOnLight(start, end);
}

// Which texels of the range in blocks first, first + LANES, ... block.
uint blockingTexels(Blocks all, int first, Range range, int level, vec4 p, float depth, inout int visited) {
  uint blocking = 0u;
  for (int j = 0; j < kBlocksAtOnce; ++j) {
    const int block = first + j * LANES;
    if (block >= all.count) break;
    ++visited;
    const ivec2 low = blockLow(all, block);
    const vec4 depths = blockDepths(low, level);
    for (int i = 0; i < 4; ++i) {
      const ivec2 texel = low + kBlockPlaces[i];
      if (any(lessThan(texel, range.low)) || any(greaterThan(texel, range.high))) continue;
      ++examinedCount;
      if (blocks(depths[i], texel, level, p, depth)) blocking |= 1u << (4 * j + i);
    }
  }
  return blocking;
}

// This invocation's part.
float gatherOccluders(vec4 p, Area area, int level) {
  const Range range = occluderRange(area, level);
  const ivec2 count = range.high - range.low + 1;
  if (float(count.x + 1) * float(count.y) > float(maxIterations)) {
    pixelClass = kCutShort;
    return 0.0;
  }
  const ivec2 blocksLow = range.low >> 1, blockCount = (range.high >> 1) - blocksLow + 1;
  const Blocks all = Blocks(2 * blocksLow, blockCount.x, blockCount.x * blockCount.y);
  const float depth = biasedDepth(p, level);
  const vec2 perTexel = tangentSize / float(resolution) * float(1 << level);
  const Throw to = Throw(p.z * perTexel / lightSize, (p.z * tangentLow - p.xy) / lightSize);
  int visited = 0;
  uint blocking = 0u;
  for (int first = firstRow; first < all.count; first += kBlocksAtOnce * LANES) {
    blocking = blockingTexels(all, first, range, level, p, depth, visited);
    while (blocking != 0u) {
      const int bit = findLSB(blocking);
      blocking &= blocking - 1u;
      throwPatch(blockLow(all, first + (bit >> 2) * LANES) + kBlockPlaces[bit & 3], level, p, depth, to);
    }
    if (isSaturated()) return 0.0;
  }
  // A driver that grants a limited number of iterations has left the loops early.
  if (blocking != 0u || visited < (all.count - firstRow + LANES - 1) / LANES) pixelClass = kCutShort;
  return 0.0;
}

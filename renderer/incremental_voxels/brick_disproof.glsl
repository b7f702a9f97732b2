// SPDX-License-Identifier: BSD-3-Clause
// What depth images say of a whole brick: kDisproofCleared or kDisproofStays, if they say it of each of its voxels, otherwise
// kDisproofSurface. All invocations of a group call it.
#include "renderer/incremental_voxels/disproof.glsl"

#ifdef TILED
layout(binding = kViewTilesUnit) uniform sampler2D viewTiles[VIEWS];
shared uint brickLeast, brickLargest;

vec2 tileAt(int view, ivec2 tile) {
#if VIEWS > 1
  if (view == 1) return texelFetch(viewTiles[1], tile, 0).xy;
#endif
  return texelFetch(viewTiles[0], tile, 0).xy;
}

// Of more tiles than this it is not worth while.
const int kMostTiles = 16 * kBrickLanes;

int disproofOfBrickByView(int view, ivec3 first, ivec3 end) {
  // A voxel larger on all sides than the brick: of a voxel at its border no pixel is looked at that lies outside.
  const vec3 low = vec3(first) - 1.0, high = vec3(end) + 1.0;
  float nearest = 1e30, farthest = -1e30;
  vec2 lowPlace = vec2(1e30), highPlace = vec2(-1e30);
  for (int i = 0; i < 8; ++i) {
    const vec3 corner = toView(view, mix(low, high, vec3(i & 1, i >> 1 & 1, i >> 2)));
    nearest = min(nearest, corner.z);
    farthest = max(farthest, corner.z);
    const vec2 place = viewPlace(view, vec3(corner.xy, max(corner.z, viewNear[view])));
    lowPlace = min(lowPlace, place);
    highPlace = max(highPlace, place);
  }
  const ivec2 last = viewSizePx[view] - 1;
  const bool before = nearest > viewNear[view];
  const bool isBeside = before && (any(lessThan(highPlace, vec2(-1.0))) || any(greaterThan(lowPlace, vec2(last) + 2.0)));
  const bool isWhole = all(greaterThanEqual(lowPlace, vec2(1.0))) && all(lessThanEqual(highPlace, vec2(last)));
  const ivec2 from = clamp(ivec2(floor(clamp(lowPlace, vec2(-1e6), vec2(1e6)))) - 1, ivec2(0), last) / kDepthTile;
  const ivec2 to = clamp(ivec2(floor(clamp(highPlace, vec2(-1e6), vec2(1e6)))) + 1, ivec2(0), last) / kDepthTile;
  const ivec2 count = to - from + 1;
  const bool isWorth = before && !isBeside && count.x * count.y <= kMostTiles;
  if (gl_LocalInvocationIndex == 0u) {
    brickLeast = 0xffffffffu;
    brickLargest = 0u;
  }
  barrier();
  if (isWorth)
    for (int i = int(gl_LocalInvocationIndex); i < count.x * count.y; i += kBrickLanes) {
      const vec2 tile = tileAt(view, from + ivec2(i % count.x, i / count.x));
      atomicMin(brickLeast, floatBitsToUint(tile.x));
      atomicMax(brickLargest, floatBitsToUint(tile.y));
    }
  barrier();
  const float least = uintBitsToFloat(brickLeast), largest = uintBitsToFloat(brickLargest);
  barrier();
  if (isBeside) return kDisproofStays;
  if (!isWorth) return kDisproofSurface;
  // Where nothing is seen the surface is infinitely far away.
  if (least > 0.0 && nearest > (viewNear[view] / least + viewBias[view]) * (1.0 + 1e-5)) return kDisproofStays;
  const bool clears = largest > 0.0 ? farthest < (viewNear[view] / largest - viewBias[view]) * (1.0 - 1e-5) : true;
  return isWhole && clears && (least > 0.0 || skyDisproves) ? kDisproofCleared : kDisproofSurface;
}

// `stored`: where its first voxel is stored.
int disproofOfBrick(ivec3 stored) {
  const ivec3 size = min(stored + ivec3(32, kBrickSide, kBrickSide), gridSize()) - stored, first = voxelStoredAt(stored);
  // Of a brick that wraps around.
  if (voxelStoredAt(stored + size - 1) != first + size - 1) return kDisproofSurface;
  int result = kDisproofStays;
  for (int view = 0; view < USED_VIEWS; ++view) {
    const int one = disproofOfBrickByView(view, first, first + size);
    if (one == kDisproofCleared || result == kDisproofCleared)
      result = kDisproofCleared;
    else if (one == kDisproofSurface)
      result = kDisproofSurface;
  }
  return result;
}
#else
int disproofOfBrick(ivec3 stored) { return kDisproofSurface; }
#endif

// SPDX-License-Identifier: BSD-3-Clause
// Connected components of jnd >= threshold within tiles of 32 x 32 pixels. Rows are runs of bits; a run is
// united with those that it touches above.
#include "perception/popping/gpu/popping_bindings.h"
#include "perception/popping/gpu/region_table.glsl"

layout(local_size_x = kRegionTile, local_size_y = kRegionTileRows) in;

layout(binding = kRegionJndUnit) uniform sampler2D jnd;
layout(binding = kRegionSeedsUnit) uniform usampler2D seeds;
uniform float threshold;

shared uint rowBits[kRegionTile];
shared uint label[kRegionTile * kRegionTile];
shared uint seeded[kRegionTile * kRegionTile];

uint findRoot(uint pixel) {
  while (label[pixel] != pixel) pixel = label[pixel];
  return pixel;
}

void unite(uint a, uint b) {
  for (;;) {
    a = findRoot(a);
    b = findRoot(b);
    if (a == b) return;
    uint high = max(a, b), low = min(a, b);
    uint before = atomicMin(label[high], low);
    if (before == high) return;
    a = before;  // somebody hung `high` elsewhere: unite with that too
    b = low;
  }
}

bool isSet(int x, int y) { return x >= 0 && x < kRegionTile && (rowBits[y] >> uint(x) & 1u) != 0u; }

void main() {
  ivec2 size = textureSize(jnd, 0);
  ivec2 origin = ivec2(gl_WorkGroupID.xy) * kRegionTile;
  int x = int(gl_LocalInvocationID.x);
  if (gl_LocalInvocationID.y == 0u) rowBits[x] = 0u;
  barrier();
  for (int y = int(gl_LocalInvocationID.y); y < kRegionTile; y += kRegionTileRows) {
    ivec2 pixel = origin + ivec2(x, y);
    bool above = all(lessThan(pixel, size)) && texelFetch(jnd, pixel, 0).x >= threshold;
    if (above) atomicOr(rowBits[y], 1u << uint(x));
  }
  barrier();
  for (int y = int(gl_LocalInvocationID.y); y < kRegionTile; y += kRegionTileRows) {
    // The run's start: behind the nearest clear bit to the left.
    uint clearBefore = ~rowBits[y] & ((1u << uint(x)) - 1u);
    label[y * kRegionTile + x] = isSet(x, y) ? uint(y * kRegionTile + findMSB(clearBefore) + 1) : kNone;
    seeded[y * kRegionTile + x] = 0u;
  }
  barrier();
  for (int y = int(gl_LocalInvocationID.y); y < kRegionTile; y += kRegionTileRows) {
    if (y == 0 || !isSet(x, y)) continue;
    uint pixel = uint(y * kRegionTile + x), above = pixel - uint(kRegionTile);
    bool left = isSet(x - 1, y), aboveLeft = isSet(x - 1, y - 1);
    if (isSet(x, y - 1)) {
      if (!(left && aboveLeft)) unite(pixel, above);  // else the left neighbour does it
      continue;
    }
#if CONNECTIVITY == 8
    if (aboveLeft && !left) unite(pixel, above - 1u);
    if (isSet(x + 1, y - 1) && !isSet(x + 1, y)) unite(pixel, above + 1u);
#endif
  }
  barrier();
  for (int y = int(gl_LocalInvocationID.y); y < kRegionTile; y += kRegionTileRows)
    if (isSet(x, y) && texelFetch(seeds, origin + ivec2(x, y), 0).x != 0u)
      seeded[findRoot(uint(y * kRegionTile + x))] = 1u;
  barrier();
  for (int y = int(gl_LocalInvocationID.y); y < kRegionTile; y += kRegionTileRows) {
    ivec2 pixel = origin + ivec2(x, y);
    if (any(greaterThanEqual(pixel, size))) continue;
    uint index = uint(pixel.y) * uint(size.x) + uint(pixel.x), own = uint(y * kRegionTile + x);
    uint parent = kNone, flag = 0u;
    if (isSet(x, y)) {
      uint root = findRoot(own);
      ivec2 rootPixel = origin + ivec2(root % uint(kRegionTile), root / uint(kRegionTile));
      parent = uint(rootPixel.y) * uint(size.x) + uint(rootPixel.x);
      if (root == own) flag = seeded[own];
    }
    parents[index] = parent;
    roots[index] = flag;
  }
}

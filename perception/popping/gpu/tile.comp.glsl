// SPDX-License-Identifier: BSD-3-Clause
// Connected components of jnd >= threshold within tiles of 32 x 32 pixels. Rows are runs of bits; a run is
// united with those that it touches above.
#include "perception/popping/gpu/region_table.glsl"

layout(local_size_x = 32, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D jnd;
layout(binding = 1) uniform usampler2D seeds;
uniform float threshold;

const int kTile = 32;
shared uint rowBits[kTile];
shared uint label[kTile * kTile];
shared uint seeded[kTile * kTile];

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

bool isSet(int x, int y) { return x >= 0 && x < kTile && (rowBits[y] >> uint(x) & 1u) != 0u; }

void main() {
  ivec2 size = textureSize(jnd, 0);
  ivec2 origin = ivec2(gl_WorkGroupID.xy) * kTile;
  int x = int(gl_LocalInvocationID.x);
  if (gl_LocalInvocationID.y == 0u) rowBits[x] = 0u;
  barrier();
  for (int y = int(gl_LocalInvocationID.y); y < kTile; y += 8) {
    ivec2 pixel = origin + ivec2(x, y);
    bool above = all(lessThan(pixel, size)) && texelFetch(jnd, pixel, 0).x >= threshold;
    if (above) atomicOr(rowBits[y], 1u << uint(x));
  }
  barrier();
  for (int y = int(gl_LocalInvocationID.y); y < kTile; y += 8) {
    // The run's start: behind the nearest clear bit to the left.
    uint clearBefore = ~rowBits[y] & ((1u << uint(x)) - 1u);
    label[y * kTile + x] = isSet(x, y) ? uint(y * kTile + findMSB(clearBefore) + 1) : kNone;
    seeded[y * kTile + x] = 0u;
  }
  barrier();
  for (int y = int(gl_LocalInvocationID.y); y < kTile; y += 8) {
    if (y == 0 || !isSet(x, y)) continue;
    uint pixel = uint(y * kTile + x), above = pixel - uint(kTile);
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
  for (int y = int(gl_LocalInvocationID.y); y < kTile; y += 8)
    if (isSet(x, y) && texelFetch(seeds, origin + ivec2(x, y), 0).x != 0u)
      seeded[findRoot(uint(y * kTile + x))] = 1u;
  barrier();
  for (int y = int(gl_LocalInvocationID.y); y < kTile; y += 8) {
    ivec2 pixel = origin + ivec2(x, y);
    if (any(greaterThanEqual(pixel, size))) continue;
    uint index = uint(pixel.y) * uint(size.x) + uint(pixel.x), own = uint(y * kTile + x);
    uint parent = kNone, flag = 0u;
    if (isSet(x, y)) {
      uint root = findRoot(own);
      ivec2 rootPixel = origin + ivec2(root % uint(kTile), root / uint(kTile));
      parent = uint(rootPixel.y) * uint(size.x) + uint(rootPixel.x);
      if (root == own) flag = seeded[own];
    }
    parents[index] = parent;
    roots[index] = flag;
  }
}

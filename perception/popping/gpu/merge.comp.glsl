// SPDX-License-Identifier: BSD-3-Clause
// Unites the parts of a region that lie in tiles side by side. One invocation for each pixel below a tile's upper
// edge, then one for each right of a tile's left edge.
#include "perception/popping/gpu/region_table.glsl"

layout(local_size_x = kRegionGroup) in;

uniform ivec2 sizePx;

uint indexOf(ivec2 pixel) { return uint(pixel.y) * uint(sizePx.x) + uint(pixel.x); }

bool isSet(ivec2 pixel) {
  return all(greaterThanEqual(pixel, ivec2(0))) && all(lessThan(pixel, sizePx)) &&
         parents[indexOf(pixel)] != kNone;
}

uint findRoot(uint pixel) {
  for (uint parent = parents[pixel]; parent != pixel; parent = parents[pixel]) pixel = parent;
  return pixel;
}

void unite(ivec2 first, ivec2 second) {
  uint a = indexOf(first), b = indexOf(second);
  for (;;) {
    a = findRoot(a);
    b = findRoot(b);
    if (a == b) return;
    uint high = max(a, b), low = min(a, b);
    uint before = atomicMin(parents[high], low);
    if (before == high) return;
    a = before;
    b = low;
  }
}

// `towards` leads over the edge, `along` along it. What neighbours along the edge unite is left to them.
void uniteAcross(ivec2 pixel, ivec2 towards, ivec2 along, bool mayLeave) {
  if (!isSet(pixel)) return;
  bool before = isSet(pixel - along), beforeAcross = isSet(pixel + towards - along);
  if (isSet(pixel + towards)) {
    if (!(mayLeave && before && beforeAcross)) unite(pixel, pixel + towards);
    return;
  }
#if CONNECTIVITY == 8
  if (beforeAcross && !before) unite(pixel, pixel + towards - along);
  if (isSet(pixel + towards + along) && !isSet(pixel + along)) unite(pixel, pixel + towards + along);
#endif
}

void main() {
  uint index = gl_GlobalInvocationID.x;
  uint edgeRows = uint((sizePx.y - 1) / kRegionTile), edgeColumns = uint((sizePx.x - 1) / kRegionTile);
  uint width = uint(sizePx.x), height = uint(sizePx.y);
  if (index < edgeRows * width) {
    ivec2 pixel = ivec2(index % width, (index / width + 1u) * uint(kRegionTile));
    uniteAcross(pixel, ivec2(0, -1), ivec2(1, 0), true);
    return;
  }
  index -= edgeRows * width;
  if (index >= edgeColumns * height) return;
  ivec2 pixel = ivec2((index / height + 1u) * uint(kRegionTile), index % height);
  // In a tile's first row the edge above relies on this one: four tiles that meet in a set corner would else
  // each leave it to the others.
  uniteAcross(pixel, ivec2(-1, 0), ivec2(0, 1), pixel.y % kRegionTile != 0);
}

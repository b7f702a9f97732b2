// SPDX-License-Identifier: BSD-3-Clause
// Fills the empty pixels of tiles from coarser levels, a group a tile. See fixed_points.h. SIDE: of a tile, a power of two, px.
#include "renderer/many_lods/many_lods_bindings.h"

layout(local_size_x = kPushPullGroup) in;
layout(std430, binding = kSplatDepthsBuffer) buffer Depths { uint depths[]; };

uniform int levels;
uniform float tolerance;

// Level after level, the finest first; negative where nothing is.
shared float pyramid[SIDE * SIDE * 4 / 3 + 4];

void main() {
  const int me = int(gl_LocalInvocationIndex);
  const uint tile = gl_WorkGroupID.x * uint(SIDE * SIDE);
  for (int i = me; i < SIDE * SIDE; i += kPushPullGroup) {
    const uint depth = depths[tile + uint(i)];
    pyramid[i] = depth == kAtlasEmpty ? -1.0 : uintBitsToFloat(depth);
  }
  int first = 0, side = SIDE;
  for (int level = 0; level < levels; ++level) {
    barrier();
    const int above = first + side * side;
    for (int i = me; i < side * side / 4; i += kPushPullGroup) {
      const int x = 2 * (i % (side / 2)), y = 2 * (i / (side / 2));
      float nearest = 2.0;
      for (int child = 0; child < 4; ++child) {
        const float depth = pyramid[first + (y + child / 2) * side + x + child % 2];
        if (depth >= 0.0) nearest = min(nearest, depth);
      }
      // The mean of those that belong to the nearest surface.
      float sum = 0.0, count = 0.0;
      for (int child = 0; child < 4; ++child) {
        const float depth = pyramid[first + (y + child / 2) * side + x + child % 2];
        if (depth < 0.0 || depth > nearest * (1.0 + tolerance)) continue;
        sum += depth;
        count += 1.0;
      }
      pyramid[above + i] = count > 0.0 ? sum / count : -1.0;
    }
    first = above;
    side /= 2;
  }
  for (int level = levels; level > 0; --level) {
    barrier();
    const int belowSide = side * 2, below = first - belowSide * belowSide;
    for (int i = me; i < belowSide * belowSide; i += kPushPullGroup)
      if (pyramid[below + i] < 0.0) pyramid[below + i] = pyramid[first + (i / belowSide) / 2 * side + (i % belowSide) / 2];
    first = below;
    side = belowSide;
  }
  barrier();
  for (int i = me; i < SIDE * SIDE; i += kPushPullGroup)
    depths[tile + uint(i)] = pyramid[i] < 0.0 ? kAtlasEmpty : floatBitsToUint(pyramid[i]);
}

// SPDX-License-Identifier: BSD-3-Clause
// The bit of the fragment's voxel; the logic operation OR joins those of a pixel.
#include "renderer/voxels/volume.glsl"

layout(location = 0) in float depth;
layout(location = 0) out uvec4 masks[TARGETS];

void main() {
  const int size = gridSize()[AXIS];
  if (!(depth >= -kVoxelSlack && depth <= float(size) + kVoxelSlack)) discard;
  const int place = clamp(int(floor(depth)), 0, size - 1), word = (place >> 5) & 3;
  const uvec4 bits = uvec4(equal(ivec4(0, 1, 2, 3), ivec4(word))) * (1u << (place & 31));
  for (int i = 0; i < TARGETS; ++i) masks[i] = i == place >> 7 ? bits : uvec4(0u);
}

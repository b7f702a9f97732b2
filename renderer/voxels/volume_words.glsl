// SPDX-License-Identifier: BSD-3-Clause
// Words of a volume's bits, an invocation each, as Volume dispatches them.
#include "renderer/voxels/volume.glsl"

layout(local_size_x = kVolumeWords) in;

// Texel of this invocation's word; z is beyond the grid where there is none.
ivec3 wordOf(uint lane) {
  const uint group = gl_WorkGroupID.x + gl_NumWorkGroups.x * gl_WorkGroupID.y, word = uint(kVolumeWords) * group + lane;
  const uint wide = uint(gridSizeX + 31) / 32u, row = word / wide;
  return ivec3(word - wide * row, row % uint(gridSizeY), row / uint(gridSizeY));
}

bool isWord(ivec3 texel) { return texel.z < gridSizeZ; }

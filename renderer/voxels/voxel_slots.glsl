// SPDX-License-Identifier: BSD-3-Clause
// Where a voxel's sums are: by its number among the grid's voxels, or (OCCUPIED_SUMS) among the occupied ones.
#include "renderer/voxels/volume.glsl"

const uint kNoSlot = 0xffffffffu;

#ifdef OCCUPIED_SUMS
layout(binding = kVolumeSlotsUnit) uniform usampler2DArray volumeSlots;
uniform uint slotCapacity;

// Of the voxel at `bit` of a word; kNoSlot: it is empty, or there is no room for it.
uint slotIn(uint word, uint first, uint bit, uint capacity) {
  if ((word >> bit & 1u) == 0u) return kNoSlot;
  const uint slot = first + uint(bitCount(word & ((1u << bit) - 1u)));
  return slot < capacity ? slot : kNoSlot;
}

uint slotOf(ivec3 voxel) {
  const ivec3 texel = ivec3(voxel.x >> 5, voxel.yz);
  return slotIn(texelFetch(volumeBits, texel, 0).x, texelFetch(volumeSlots, texel, 0).x, uint(voxel.x & 31), slotCapacity);
}
#else
uint slotOf(ivec3 voxel) { return uint(voxel.x + gridSizeX * (voxel.y + gridSizeY * voxel.z)); }
#endif

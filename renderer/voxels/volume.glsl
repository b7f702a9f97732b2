// SPDX-License-Identifier: BSD-3-Clause
// Voxels as Volume::configure() binds them. Positions in voxels: the integer parts are the voxel. Attachments: see
// VoxelAttribute.
#include "renderer/voxels/voxel_bindings.h"

layout(binding = kVolumeBitsUnit) uniform usampler2DArray volumeBits;
#ifdef VOLUME_OCCUPANCY
layout(binding = kVolumeOccupancyUnit) uniform sampler2DArray volumeOccupancy;
#endif
#ifdef VOLUME_ALBEDO
layout(binding = kVolumeAlbedoUnit) uniform sampler2DArray volumeAlbedo;
#endif
#ifdef VOLUME_NORMAL
layout(binding = kVolumeNormalUnit) uniform sampler2DArray volumeNormal;
#endif
#ifdef VOLUME_LIGHT
layout(binding = kVolumeLightUnit) uniform sampler2DArray volumeLight;
#endif
#ifdef VOLUME_SH_GREY
layout(binding = kVolumeShGreyUnit) uniform sampler2DArray volumeShGrey;
#endif
#ifdef VOLUME_SH_RED
layout(binding = kVolumeShRedUnit) uniform sampler2DArray volumeShRed;
layout(binding = kVolumeShGreenUnit) uniform sampler2DArray volumeShGreen;
layout(binding = kVolumeShBlueUnit) uniform sampler2DArray volumeShBlue;
#endif
uniform vec3 gridOrigin;  // relative to the scene's anchor
uniform float voxelSize;
uniform int gridSizeX, gridSizeY, gridSizeZ;

ivec3 gridSize() { return ivec3(gridSizeX, gridSizeY, gridSizeZ); }

vec3 toVoxels(vec3 position) { return (position - gridOrigin) / voxelSize; }

bool isInGrid(ivec3 voxel) { return all(greaterThanEqual(voxel, ivec3(0))) && all(lessThan(voxel, gridSize())); }

bool isOccupied(ivec3 voxel) {
  if (!isInGrid(voxel)) return false;
  return ((texelFetch(volumeBits, ivec3(voxel.x >> 5, voxel.yz), 0).x >> (voxel.x & 31)) & 1u) != 0u;
}

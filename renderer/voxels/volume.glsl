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

// A volume that scrolls (TOROIDAL) keeps voxels where they are while its grid moves; what leaves on one side enters on the other.
#ifdef TOROIDAL
uniform int wrapX, wrapY, wrapZ;  // where voxel (0, 0, 0) is stored
ivec3 storedVoxel(ivec3 voxel) {
  const ivec3 at = voxel + ivec3(wrapX, wrapY, wrapZ);
  return at - gridSize() * ivec3(greaterThanEqual(at, gridSize()));
}
ivec3 voxelStoredAt(ivec3 at) {
  const ivec3 voxel = at - ivec3(wrapX, wrapY, wrapZ);
  return voxel + gridSize() * ivec3(lessThan(voxel, ivec3(0)));
}
#else
ivec3 storedVoxel(ivec3 voxel) { return voxel; }
ivec3 voxelStoredAt(ivec3 at) { return at; }
#endif

bool isOccupied(ivec3 voxel) {
  if (!isInGrid(voxel)) return false;
  const ivec3 at = storedVoxel(voxel);
  return ((texelFetch(volumeBits, ivec3(at.x >> 5, at.yz), 0).x >> (at.x & 31)) & 1u) != 0u;
}

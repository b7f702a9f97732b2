// SPDX-License-Identifier: BSD-3-Clause
// What shaders of voxels are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::voxels {
#endif

// Voxelizer: an invocation sets up a triangle, and the group shares the columns of all of its triangles. What
// has more than kVoxelizeAlone columns is queued in parts of kVoxelizePart.
const int kVoxelizeGroup = 64;
const int kVoxelizeAlone = 24;
const int kVoxelizePart = 256;
const uint kVoxelBitsImage = 0u;  // r32ui array: bit x % 32 of texel (x / 32, y, z)
// Of the scene's storage buffers these use positions, indices, materials and the triangles' materials, and
// leave 6 and 7 to the tree of rays.
const uint kVoxelSumsBuffer = 3u;
const uint kVoxelQueueBuffer = 4u;
struct VoxelQueueHeader {  // std430; then uvec2: triangle, first column of the part
  uint queued[2];          // by turns
  uint cutShort;           // rays to lamps that a software renderer's limit ended
  uint unused0;
};
#ifdef __cplusplus
static_assert(sizeof(VoxelQueueHeader) == 16);
#endif
const int kVoxelLamps = 8;

// Volume, as volume.glsl reads it: usampler2DArray and sampler2DArray.
const uint kVolumeSlotsUnit = 6u;  // usampler2DArray, as the bits: number of a word's first occupied voxel
const uint kVolumeShBlueUnit = 7u;
const uint kVolumeShGreenUnit = 8u;
const uint kVolumeShRedUnit = 9u;
const uint kVolumeShGreyUnit = 10u;
const uint kVolumeOccupancyUnit = 11u;
const uint kVolumeBitsUnit = 12u;
const uint kVolumeAlbedoUnit = 13u;
const uint kVolumeNormalUnit = 14u;
const uint kVolumeLightUnit = 15u;

// Volume, as its own shaders write it. A group takes kVolumeWords words of bits, an invocation each.
const int kVolumeWords = 64;
const uint kVolumeOccupancyImage = 0u;
const uint kVolumeAlbedoImage = 1u;
const uint kVolumeNormalImage = 2u;
const uint kVolumeLightImage = 3u;
const uint kVolumeShGreyImage = 4u;
const uint kVolumeShRedImage = 5u;
const uint kVolumeShGreenImage = 6u;
const uint kVolumeShBlueImage = 7u;
const uint kVolumeEmptyBitsImage = 0u;
const uint kVolumeSlotsImage = 0u;
const uint kVolumeOccupiedBuffer = 3u;  // number of occupied voxels
const uint kVolumeBaseBitsUnit = 0u;
const uint kVolumeBaseSlotsUnit = 1u;
const uint kVolumeBaseSumsBuffer = 5u;

// Rounding that shaders allow for, in voxels: positions of up to 1024 voxels, kept as floats relative to the
// scene's anchor, are off by up to 2^-13, and tests of edges and planes add as much again.
const float kVoxelSlack = 0.0009765625f;
// Rays to lamps start this far off the surface, in voxels, on its lit side.
const float kVoxelRayOffset = 0.0078125f;

#ifdef __cplusplus
}  // namespace limen::voxels
#endif

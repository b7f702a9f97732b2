// SPDX-License-Identifier: BSD-3-Clause
// What shaders of voxels are bound to. For C++ and GLSL. Storage buffers 0 to 5 are left to the scene and its
// surfaces.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::voxels {
#endif

// Voxelizer: a group sets up a triangle an invocation. What has more columns than kVoxelizeAlone is shared by
// the group.
const int kVoxelizeGroup = 64;
const int kVoxelizeAlone = 24;
const uint kVoxelBitsImage = 0u;   // r32ui array: bit x % 32 of texel (x / 32, y, z)
const uint kVoxelSumsBuffer = 6u;  // kVoxelSums words a voxel

// Sums of a voxel: number of entries; then, in units of 1 / kVoxelFixed, albedo (3), normal (3, signed) and
// opacity.
const uint kVoxelSums = 8u;
const float kVoxelFixed = 4096.0f;

// Volume, as volume.glsl reads it.
const uint kVolumeBitsUnit = 12u;    // usampler2DArray
const uint kVolumeAlbedoUnit = 13u;  // sampler2DArray
const uint kVolumeNormalUnit = 14u;
const uint kVolumeAlbedoImage = 1u;
const uint kVolumeNormalImage = 2u;

// Rounding that shaders allow for, in voxels: positions of up to 1024 voxels, kept as floats relative to the
// scene's anchor, are off by up to 2^-13, and tests of edges and planes add as much again.
const float kVoxelSlack = 0.0009765625f;

#ifdef __cplusplus
}  // namespace limen::voxels
#endif

// SPDX-License-Identifier: BSD-3-Clause
// What shaders of voxelization are bound to, besides those of voxels. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kVoxelPictureImage = 0u;

// Volumes along an axis each.
const uint kAxisVolumeXUnit = 0u;  // of triangles that face along x most
const uint kAxisVolumeYUnit = 1u;
const uint kAxisVolumeZUnit = 2u;
const uint kAxisNormalXUnit = 3u;  // for the number of fragments, where an attachment has no room for it
const uint kAxisNormalYUnit = 4u;
const uint kAxisNormalZUnit = 5u;
const uint kMergedBitsImage = 0u;
const uint kMergedAttachmentImage = 0u;

// A rasteriser keeps 8 bits of a pixel, so that corners are off by up to 2^-9 px: what must not be lost is
// drawn this much larger.
const float kRasterSlack = 0.00390625f;

// Lists of slices: item i of a triangle is its i-th slice.
const int kSliceGroup = 64;
const int kSliceAlone = 64;  // columns; of more the group takes its share
const uint kSliceCountsBuffer = 2u;
const uint kSliceSumsBuffer = 3u;

// Bricks of voxels, a group each; its invocations are as many as it has words of bits.
const int kBrickX = 32;
const int kBrickY = 8;
const int kBrickZ = 8;
const int kBrickGroup = 64;
const int kBrickAlone =
    24;  // bricks of a triangle, and columns within a brick; of more the group takes its share
const uint kBrickCountsBuffer = 2u;
const uint kBrickStartsBuffer = 3u;
const uint kBrickTrianglesBuffer = 4u;

// Bit masks: a target of 128 bits for as many voxels along the view.
const uint kMaskXUnit = 0u;
const uint kMaskYUnit = 1u;
const uint kMaskZUnit = 2u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

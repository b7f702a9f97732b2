// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of voxels in textures are bound to, besides those of depth images. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const int kMostVoxelTargets = 4;      // normal and occupancy; harmonics of red, green and blue light
const uint kVoxelSourceUnit = 4u;     // and the following
const uint kVoxelTargetImage = 0u;    // and the following
const uint kSeenNormalUnit = 8u;      // of the pixels of a view
const uint kSeenLightUnit = 9u;
const uint kSeenNormalImage = 0u;
const uint kSeenLightImage = 1u;
const uint kPackedBitsImage = 4u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

// SPDX-License-Identifier: BSD-3-Clause
// What shaders of voxelization are bound to, besides those of voxels. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kVoxelPictureImage = 0u;
const uint kAxisVolumeXUnit = 0u;  // of triangles that face along x most
const uint kAxisVolumeYUnit = 1u;
const uint kAxisVolumeZUnit = 2u;
const uint kMergedBitsImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

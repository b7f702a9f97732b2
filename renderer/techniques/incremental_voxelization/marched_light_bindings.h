// SPDX-License-Identifier: BSD-3-Clause
// What the shader of marched light is bound to, besides depth images and voxels. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kMarchedVoxelLightUnit = 15u;
const uint kMarchedPictureImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

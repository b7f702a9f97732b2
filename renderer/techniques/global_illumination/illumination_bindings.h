// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of global illumination are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Paths.
const uint kPathIdsUnit = 0u;
const uint kPathSumsImage = 0u;
const uint kPathSumsUnit = 0u;
const uint kPathPictureImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

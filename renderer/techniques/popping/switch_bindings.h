// SPDX-License-Identifier: BSD-3-Clause
// What the shader of the switch of levels is bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kClampPictureUnit = 0u;
const uint kClampShownImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

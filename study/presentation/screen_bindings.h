// SPDX-License-Identifier: BSD-3-Clause
// What the shader that shows a stimulus is bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::study {
#endif

const uint kScreenPicturesUnit = 0u;

#ifdef __cplusplus
}  // namespace limen::study
#endif

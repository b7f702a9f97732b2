// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of Fills are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::gl {
#endif

const uint kFilledImage = 0u;
const uint kFilledBuffer = 7u;
const int kFillGroup = 256;
const int kFillWords = 4;  // of an invocation

#ifdef __cplusplus
}  // namespace limen::gl
#endif

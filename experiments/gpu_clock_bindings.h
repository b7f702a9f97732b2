// SPDX-License-Identifier: BSD-3-Clause
// What the shaders that wake the GPU and measure its clock are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::experiments {
#endif

const int kBusyGroup = 64;
const uint kClockOutBuffer = 0u;

#ifdef __cplusplus
}  // namespace limen::experiments
#endif

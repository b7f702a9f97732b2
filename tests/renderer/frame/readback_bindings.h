// SPDX-License-Identifier: BSD-3-Clause
// What the test shaders are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::frame {
#endif

const uint kSumsReadbackSumsUnit = 2u;
const uint kSumsReadbackWindowsBuffer = 1u;
const uint kSumsReadbackTotalsBuffer = 2u;

#ifdef __cplusplus
}  // namespace limen::frame
#endif

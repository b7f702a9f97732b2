// SPDX-License-Identifier: BSD-3-Clause
// What the test of counts of flags binds. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::many_lods {
#endif

const uint kTestFlagsBuffer = 0u;
const uint kTestCountsBuffer = 1u;

#ifdef __cplusplus
}  // namespace limen::many_lods
#endif

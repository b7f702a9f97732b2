// SPDX-License-Identifier: BSD-3-Clause
// What the test shader of IEEE 754 numbers is bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::gl {
#endif

const uint kIeeeNumbersBuffer = 0u;
const uint kIeeeBitsBuffer = 1u;

#ifdef __cplusplus
}  // namespace limen::gl
#endif

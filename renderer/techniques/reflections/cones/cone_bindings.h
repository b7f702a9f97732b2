// SPDX-License-Identifier: BSD-3-Clause
// What the shader that computes many overlaps is bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const int kOverlapGroup = 64;
const uint kOverlapTrianglesBuffer = 0u;  // of each triangle three vec2 and two numbers of padding
const uint kOverlapsBuffer = 1u;          // of each its area, its centroid, and 0

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

// SPDX-License-Identifier: BSD-3-Clause
// What the test shaders of sample metrics are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kMetricWindowsBuffer = 0u;  // normal and depth of each sample
const uint kMetricResultsBuffer = 1u;  // MM, NC, DV, NV of each window

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

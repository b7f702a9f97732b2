// SPDX-License-Identifier: BSD-3-Clause
// What the test shaders are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

const uint kDepthBoundsReadbackAreasBuffer = 0u;
const uint kDepthBoundsReadbackRangesBuffer = 1u;

const uint kMaskReadbackRectanglesBuffer = 0u;
const uint kMaskReadbackMasksBuffer = 1u;

const uint kPrefilteredReadbackWindowsBuffer = 0u;
const uint kPrefilteredReadbackMomentsBuffer = 1u;
const uint kPrefilteredReadbackResultsBuffer = 2u;

const uint kQuadMaskReadbackQuadsBuffer = 0u;
const uint kQuadMaskReadbackResultsBuffer = 1u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

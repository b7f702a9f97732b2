// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of the levels of detail are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Geomorphing.
const int kMorphGroup = 64;
const uint kMorphPositionsBuffer = 0u;
const uint kMorphTargetsBuffer = 1u;
const uint kMorphGroupsBuffer = 2u;
const uint kMorphSharesBuffer = 3u;
const uint kMorphMovedBuffer = 4u;

// Blending.
const uint kBlendOldLevelUnit = 0u;
const uint kBlendNewLevelUnit = 1u;
const uint kBlendImage = 0u;
const uint kBlendDisplacementUnit = 2u;

// Mean of samples (BoxView).
const uint kBoxResolveSampledUnit = 0u;
const uint kBoxResolveImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

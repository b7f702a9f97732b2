// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of perceptual levels of detail are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Composite of the layers.
const int kCompositeLayers = 5;  // in one dispatch: three textures each, of the 16 that are granted
const uint kCompositeColoursUnit = 0u;
const uint kCompositeDepthsUnit = 5u;
const uint kCompositeIdsUnit = 10u;
const uint kCompositeFrontColourImage = 0u;
const uint kCompositeFrontKeyImage = 1u;
const uint kCompositeSecondColourImage = 2u;
const uint kCompositeSecondKeyImage = 3u;

// Mask of shadows.
const uint kShadowMaskReceiversUnit = 0u;
const uint kShadowMaskShadowMapUnit = 1u;
const uint kShadowMaskImage = 0u;

// Context of a layer.
const uint kContextFrontColourUnit = 0u;
const uint kContextFrontKeyUnit = 1u;
const uint kContextSecondColourUnit = 2u;
const uint kContextMaskUnit = 3u;
const uint kContextImage = 0u;

// Test of a level.
const uint kLevelTestFrontColourUnit = 0u;
const uint kLevelTestFrontKeyUnit = 1u;
const uint kLevelTestSecondColourUnit = 2u;
const uint kLevelTestSecondKeyUnit = 3u;
const uint kLevelTestThresholdUnit = 4u;
const uint kLevelTestFinestColourUnit = 5u;
const uint kLevelTestFinestDepthUnit = 6u;
const uint kLevelTestFinestIdsUnit = 7u;
const uint kLevelTestNextColourUnit = 8u;
const uint kLevelTestNextDepthUnit = 9u;
const uint kLevelTestNextIdsUnit = 10u;
const uint kLevelTestCountsBuffer = 0u;
const uint kLevelTestVisibleImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

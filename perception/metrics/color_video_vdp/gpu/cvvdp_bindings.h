// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of ColorVideoVDP are bound to, and what they share with C++. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::perception::cvvdp {
#endif

// Levels of the pyramids lie in one texture, an atlas. Signals are layers: 0 test, 1 reference.
const int kCvvdpMostBands = 16;
const int kCvvdpSensitivityLevels = 32;
const uint kCvvdpLevelsBlock = 0u;
const uint kCvvdpSensitivityBuffer = 0u;
const uint kCvvdpSumsBuffer = 1u;
const uint kCvvdpResultsBuffer = 2u;
const uint kCvvdpWeightsBuffer = 3u;

// Light: display, opponent channels, temporal filters.
const int kCvvdpLightGroupX = 32;
const int kCvvdpLightGroupY = 4;
const uint kCvvdpLightTestUnit = 0u;
const uint kCvvdpLightReferenceUnit = 1u;
const uint kCvvdpLightRingFirstUnit = 2u;
const uint kCvvdpLightRingSecondUnit = 3u;
const uint kCvvdpLightPyramidImage = 0u;
const uint kCvvdpLightRingFirstImage = 1u;
const uint kCvvdpLightRingSecondImage = 2u;

// Reduce.
const int kCvvdpReduceGroup = 16;
const uint kCvvdpReducePyramidUnit = 0u;
const uint kCvvdpReducePyramidImage = 0u;

// Contrast: an invocation makes 2 x 2 pixels.
const int kCvvdpContrastGroupX = 16;
const int kCvvdpContrastGroupY = 8;
const uint kCvvdpContrastPyramidUnit = 0u;
const uint kCvvdpContrastMutualImage = 0u;
const uint kCvvdpContrastChangeImage = 1u;

// Mask: a group makes 32 x 12 pixels, an invocation three below each other.
const int kCvvdpMaskTileX = 32;
const int kCvvdpMaskTileY = 12;
const int kCvvdpMaskRun = 3;
const int kCvvdpBlurRadius = 6;
const uint kCvvdpMaskMutualUnit = 0u;
const uint kCvvdpMaskChangeUnit = 1u;
const uint kCvvdpMaskMapImage = 0u;

// Finish: sums of each band; the base band.
const int kCvvdpFinishGroup = 256;
const uint kCvvdpFinishPyramidUnit = 0u;
const uint kCvvdpFinishMapImage = 0u;

// Collapse: the map.
const uint kCvvdpCollapseMapUnit = 0u;
const uint kCvvdpCollapseMapImage = 0u;

#ifdef __cplusplus
}  // namespace limen::perception::cvvdp
#endif

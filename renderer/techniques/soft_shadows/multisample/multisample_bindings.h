// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of sampling below the pixel are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Choice of the samples to find visibility for.
const uint kSampleIdsUnit = 0u;
const uint kSamplePointIdsImage = 0u;
const uint kSamplePlacesImage = 1u;
const uint kSampleChosenDepthsImage = 2u;
const uint kSampleDepthsImage = 3u;

// All samples.
const uint kSampleSpreadVisibilityUnit = 0u;
const uint kSampleSpreadVisibilityImage = 0u;

// From samples to pixels.
const uint kSampleResolveSampleDepthsUnit = 0u;
const uint kSampleResolveDepthsUnit = 1u;
const uint kSampleResolveVisibilityUnit = 2u;
const uint kSampleResolveVisibilityImage = 0u;
const uint kSampleResolveCountsImage = 1u;

// Mean of the samples of a larger image.
const uint kBoxMeanSampledUnit = 0u;
const uint kBoxMeanVisibilityImage = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

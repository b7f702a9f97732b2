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

const uint kSampleMarksUnit = 1u;  // of listed pixels
const uint kSampleIdsBuffer = 5u;  // as SampleRaster has them
const uint kSampleListBuffer = 7u;
const uint kGatherCentreIdsUnit = 0u;
const uint kGatherSamplesUnit = 1u;
const uint kGatherMarksImage = 0u;

// One point for each surface that a pixel's samples see. A sample's source of visibility: none, since it is
// no receiver; the pixel's own point; or a further point i as kSourcePoints + i.
const uint kSourceNone = 0u;
const uint kSourceOwn = 1u;
const uint kSourcePoints = 2u;
struct SurfaceCounts {  // std430
  uint points;          // further points, of which those beyond the capacity are left out
  uint dropped;         // samples on a surface whose point was left out
  uint complexPixels;
  uint padding;
};
#ifdef __cplusplus
static_assert(sizeof(SurfaceCounts) == 16);
#endif
const uint kSurfaceCountsBuffer = 3u;
const uint kSurfaceCentreIdsUnit = 0u;
const uint kSurfaceVisibilityUnit = 2u;
const uint kSurfacePointIdsImage = 0u;
const uint kSurfacePlacesImage = 1u;
const uint kSurfaceVisibilityImage = 0u;

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

// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of sparse visibility are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Uniform sampling.
const uint kSparseGridIdsUnit = 0u;
const uint kSparseGridIdsImage = 0u;
const uint kSparseGridPlacesImage = 1u;

// Adaptive sampling.
const uint kSparseReceiversUnit = 0u;
const uint kSparseDepthsUnit = 1u;
const uint kSparseNormalsUnit = 2u;
const uint kSparseChooseIdsUnit = 3u;
const uint kSparseChooseMinimumMapUnit = 4u;
const uint kSparseChooseIdsImage = 0u;
const uint kSparseChoosePlacesImage = 1u;
const uint kSparseChooseSlotsImage = 2u;
const uint kSparseChooseCountsBuffer = 0u;

// Set in a slot of a pixel that was not chosen; the other bits hold its level.
const uint kSkippedSlot = 0x80000000u;

// Pull.
const uint kSparsePullSlotsUnit = 0u;
const uint kSparsePullDepthsUnit = 1u;
const uint kSparsePullSampledVisibilityUnit = 2u;
const uint kSparsePullFinerPointsUnit = 0u;
const uint kSparsePullFinerWeightsUnit = 1u;
const uint kSparsePullNormalsUnit = 3u;
const uint kSparsePullPointsImage = 0u;
const uint kSparsePullWeightsImage = 1u;

// Where a pixel's visibility comes from.
const uint kClassNoReceiver = 0u;
const uint kClassInterpolated = 1u;
const uint kClassNearestInDepth = 2u;  // no sample lies on its surface
const uint kClassNoSample = 3u;        // no sample in reach: taken as lit
const uint kClassOwnSample = 4u;       // it is a point that was asked for
const uint kSampleClassCount = 5u;

// Reconstruction of a pixel, by any of the two below.
const uint kSparseReconstructVisibilityImage = 0u;
const uint kSparseReconstructClassImage = 1u;

// From a grid.
const uint kSparseUpsampleGridReceiversUnit = 3u;
const uint kSparseUpsampleGridDepthsUnit = 4u;
const uint kSparseUpsampleGridNormalsUnit = 5u;
const uint kSparseUpsampleGridVisibilityUnit = 6u;

// From the pulled levels.
const uint kSparsePushSlotsUnit = 3u;
const uint kSparsePushSampledVisibilityUnit = 4u;
const uint kSparsePushPulledPointsUnit = 5u;
const uint kSparsePushPulledWeightsUnit = 6u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

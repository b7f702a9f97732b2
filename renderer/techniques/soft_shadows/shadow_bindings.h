// SPDX-License-Identifier: BSD-3-Clause
// What the programs of a visibility pass are bound to: one table, as one program can have many of these
// parts. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Every pass (VisibilityPass).
const uint kReceiversUnit = 0u;
const uint kReceiverPlanesUnit = 8u;
const uint kVisibilityImage = 0u;
const uint kCountsImage = 1u;
const uint kSearchImage = 2u;

// Shadow map, or its pyramid and structure, or its averages.
const uint kShadowMapUnit = 1u;
const uint kMinimumMapUnit = 1u;
const uint kMaximumMapUnit = 2u;
const uint kMultiScaleMapUnit = 3u;
const uint kAveragesUnit = 2u;

// Peeled layers.
const uint kSecondLayerUnit = 4u;
const uint kThirdLayerUnit = 5u;
const uint kFourthLayerUnit = 6u;

// Taps of the solid angle.
const uint kSolidAngleTapsBuffer = 0u;

// Masks of the light.
const uint kLightMaskBuffer = 0u;
const uint kRectangleMasksUnit = 6u;
const uint kHalfSpacesUnit = 7u;
const uint kKeptMasksImage = 3u;

// Occluder search.
const uint kTexelBiasesUnit = 9u;
const uint kRectDepthsUnit = 10u;
const uint kRectExtentsUnit = 11u;
const uint kBudgetMapUnit = 12u;
const uint kSampledDepthsUnit = 4u;

// Search and gathering as two passes.
// The list of pixels has x in their lower half, y in the upper; of it:
struct WorkListHeader {                       // std430
  uint groupsPerRow, groupRows, groupLayers;  // of an indirect dispatch over them
  uint pixelCount;
};
#ifdef __cplusplus
static_assert(sizeof(WorkListHeader) == 16 && offsetof(WorkListHeader, pixelCount) == 12);
#endif
const uint kSplitAreasImage = 6u;
const uint kSplitCameraDepthUnit = 15u;
const uint kSplitLevelsImage = 4u;
const uint kSplitHalfSmoothedImage = 5u;
const uint kSplitSearchAreasUnit = 13u;
const uint kSplitLevelMapUnit = 14u;
const uint kNextWorkHeaderBuffer = 3u;
const uint kWorkHeaderBuffer = 4u;
const uint kWorkListBuffer = 7u;
const uint kWorkListGroup = 64u;  // invocations of a group that works on the list

// Steps between levels, after a pass.
const uint kStepsCountedWorkImage = 1u;
const uint kStepsCountedSearchImage = 2u;
const uint kStepsImage = 4u;
const uint kStepsPositionsUnit = 14u;
const uint kStepsNormalsUnit = 15u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

// SPDX-License-Identifier: BSD-3-Clause
// What the passes around a visibility pass are bound to: budgets, and what happens between search and
// gathering. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::techniques {
#endif

// Smoothing of levels.
const uint kSmoothLevelsImage = 0u;

// Ordering of the work list.
const uint kWorkBins = 64u;  // as many as a group has invocations
const uint kOrderWorkBinsBuffer = 5u;
const uint kOrderWorkOrderedListBuffer = 6u;

// Budget by distance from the gaze.
const uint kRadialBudgetImage = 0u;

// Budget by thresholds.
const uint kPerceptualBudgetThresholdsUnit = 0u;
const uint kPerceptualBudgetDirectLightUnit = 1u;
const uint kPerceptualBudgetImage = 0u;

// Budget by masking: rows, then columns.
const uint kMaskingBudgetPictureUnit = 0u;
const uint kMaskingBudgetReceiversUnit = 1u;
const uint kMaskingBudgetRowsImage = 0u;
const uint kMaskingBudgetRowsUnit = 0u;
const uint kMaskingBudgetImage = 0u;

// Budget by frame time.
const uint kFrameTimeBudgetImage = 0u;
const uint kFrameTimeBudgetBaseMapUnit = 0u;

#ifdef __cplusplus
}  // namespace limen::techniques
#endif

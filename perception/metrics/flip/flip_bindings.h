// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of FLIP are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::perception {
#endif

// Filters of both passes.
const uint kFlipFiltersBlock = 0u;

// Rows.
const int kFlipRowsGroupX = 128;
const int kFlipRowsGroupY = 2;
const uint kFlipRowsTestImageUnit = 0u;
const uint kFlipRowsReferenceImageUnit = 1u;
const uint kFlipRowsTestSensitivityImage = 0u;
const uint kFlipRowsReferenceSensitivityImage = 1u;
const uint kFlipRowsDetectorsImage = 2u;
const uint kFlipRowsSmoothedImage = 3u;

// Columns.
const int kFlipColumnsGroupX = 32;
const int kFlipColumnsGroupY = 4;
const uint kFlipColumnsTestSensitivityUnit = 0u;
const uint kFlipColumnsReferenceSensitivityUnit = 1u;
const uint kFlipColumnsDetectorsUnit = 2u;
const uint kFlipColumnsSmoothedUnit = 3u;
const uint kFlipErrorMapImage = 0u;
const uint kFlipGroupSumsBuffer = 0u;

// Mean.
const int kFlipMeanGroup = 256;
const uint kFlipMeanResultBuffer = 1u;

#ifdef __cplusplus
}  // namespace limen::perception
#endif

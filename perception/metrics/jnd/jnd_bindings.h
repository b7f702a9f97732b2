// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of the JND metrics are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::perception {
#endif

// Pictures as shown.
const uint kShowTestUnit = 0u;
const uint kShowReferenceUnit = 1u;
const uint kShowAlbedoUnit = 2u;
const uint kShowDirectUnit = 3u;
const uint kShowMaskUnit = 4u;
const uint kShowDisplacementUnit = 5u;
const uint kShowDepthBeforeUnit = 6u;
const uint kShowEarlierDepthUnit = 7u;
const uint kShowEarlierTestUnit = 8u;
const uint kShowEarlierReferenceUnit = 9u;
const uint kShowActualImage = 0u;
const uint kShowPredictedImage = 1u;
const uint kShowEvaluatedImage = 2u;

// Statistics of a map.
const uint kCountJndUnit = 0u;
const uint kCountEvaluatedUnit = 1u;
const uint kStatisticsBuffer = 0u;
const uint kJndRegionsBuffer = 1u;
const int kCountGroup = 16;  // side of the work group
const int kCountTile = 64;   // px of the side that a group counts
const int kJndBins = 2048;   // of the first round; later rounds have half as many for each rank
const int kJndRanks = 2;     // median, 95th percentile
const int kChooseGroup = 256;
struct JndStatistics {  // std430; then the histogram
  uint evaluatedPx;
  uint visiblePx;    // of at least 1 JND
  uint largestBits;  // floatBitsToUint
  uint regionCount;
  uint valueBits[2];  // of each rank: the bits found so far
  uint rank[2];       // among the values that share these
  float rating;       // highest of any region
  uint unused0, unused1, unused2;
};
#ifdef __cplusplus
static_assert(sizeof(JndStatistics) == 48 && offsetof(JndStatistics, rating) == 32);
#endif

#ifdef __cplusplus
}  // namespace limen::perception
#endif

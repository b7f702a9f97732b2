// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of the popping predictor are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::perception {
#endif

// Groups of the passes that make a pixel each.
const int kPoppingGroupX = 32;
const int kPoppingGroupY = 8;

// What inputs and contrasts had to be replaced.
struct PoppingCounters {  // std430
  uint flushed;
  uint guarded;
};
#ifdef __cplusplus
static_assert(sizeof(PoppingCounters) == 8);
#endif
const uint kPoppingCountersBuffer = 0u;

// Light, cone responses, seeds.
const uint kLightActualUnit = 0u;
const uint kLightPredictedUnit = 1u;
const uint kLightActualDisplacementUnit = 2u;
const uint kLightPredictedDisplacementUnit = 3u;
const uint kLightConesImage = 0u;
const uint kLightSeedsImage = 1u;

// Mean luminance.
const int kMeanGroup = 256;
const uint kMeanConesUnit = 0u;
const uint kMeanLuminanceBuffer = 1u;

// Coarser levels.
const uint kReduceConesUnit = 0u;
const uint kReduceCoarserImage = 0u;

// Response of a level.
const uint kResponseConesUnit = 0u;
const uint kResponseSensitivitiesUnit = 2u;
const uint kResponseSteadyUnit = 6u;
const uint kResponseOnsetUnit = 7u;
const uint kResponseNormalisedUnit = 8u;
const uint kResponsePartWeightsUnit = 9u;
const uint kNormalisedImage = 0u;
// castleCSF's kink in tables over luminance, see ResponseTableGrid: rows of OnsetTable, from the kink on.
const int kPoppingKinkNodes = 147;
const float kPoppingKinkCdM2 = 0.0112770204f;  // castleKinkCdM2()
const float kPoppingKinkEndCdM2 = 0.049964959f;
const float kPoppingKinkExponent = 0.1898f;  // kCastleKinkExponent

// Differences of a level.
const uint kDifferencesImage = 0u;

// Sum over levels.
const uint kCollapseDifferencesUnit = 3u;
const uint kCollapseDisocclusionUnit = 4u;
const uint kCollapseFlickerUnit = 5u;
const uint kCollapseJndImage = 0u;

// Weights of disocclusion.
const uint kDisocclusionDepthOfPixel0Unit = 0u;
const uint kDisocclusionDisplacement0Unit = 1u;
const uint kDisocclusionPreviousDepth0Unit = 2u;
const uint kDisocclusionDepthOfPixel1Unit = 3u;
const uint kDisocclusionDisplacement1Unit = 4u;
const uint kDisocclusionPreviousDepth1Unit = 5u;
const uint kDisocclusionWeightsImage = 0u;

// Weights of flicker.
const uint kFlickerActualUnit = 0u;
const uint kFlickerPredictedUnit = 1u;
const uint kFlickerPreviousShadingUnit = 2u;
const uint kFlickerPreviousFrameUnit = 3u;
const uint kFlickerDisplacementUnit = 4u;
const uint kFlickerDepthOfPixelUnit = 5u;
const uint kFlickerPreviousDepthUnit = 6u;
const uint kFlickerWeightsImage = 0u;

// Regions.
struct RegionRecord {  // std430
  uint sizePx;
  uint sum[4];       // of (jnd / threshold)^p, fixed point: least word first, units of 2^-16
  uint largestBits;  // of the jnd, as floatBitsToUint
  uint leastX, leastY, mostX, mostY;
  uint x0, x1, y0, y1;  // sums of pixel coordinates, 64 bits each
  float sigma, rating;
};
struct RegionTableHeader {  // std430; then the records, by label - 1
  uint regionCount, unused0, unused1, unused2;
};
#ifdef __cplusplus
static_assert(sizeof(RegionRecord) == 64 && offsetof(RegionRecord, largestBits) == 20 &&
              offsetof(RegionRecord, x0) == 40 && offsetof(RegionRecord, rating) == 60);
static_assert(sizeof(RegionTableHeader) == 16);
#endif
const int kRegionTile = 32;       // of pixels whose trees a group makes
const int kRegionTileRows = 8;    // at a time
const uint kRegionChunk = 4096u;  // pixels whose roots a group counts
const int kRegionGroup = 256;     // of all kernels but the two over tiles
const int kStatsGroupX = 32;
const int kStatsGroupY = 4;
const int kStatsRows = 16;  // pixels of an invocation, one above the other
const uint kRegionParentsBuffer = 0u;
const uint kRegionRootsBuffer = 1u;
const uint kRegionTableBuffer = 2u;
const uint kRegionJndUnit = 0u;
const uint kRegionSeedsUnit = 1u;
const uint kRegionChunksBuffer = 3u;
const uint kRegionLabelsImage = 0u;

#ifdef __cplusplus
}  // namespace limen::perception
#endif

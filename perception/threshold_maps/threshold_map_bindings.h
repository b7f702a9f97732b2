// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of threshold maps are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::perception {
#endif

// Every pass.
struct ThresholdRun {  // std140
  vec4 kernel;         // five taps: outer, inner, centre
  vec4 light;          // black level, white less black, largest luminance [cd/m2], least denominator [cd/m2]
  vec4 rule;           // blend to the next level for adaptation, flat epsilon, share of the TVI
  vec4 masking;        // constants of the masking model
  vec4 bands[7];       // frequency [cpd], 1 / gain, F where it is constant else 0, 1 where F is held to 1
};
#ifdef __cplusplus
static_assert(sizeof(ThresholdRun) == 176 && offsetof(ThresholdRun, light) == 16 &&
              offsetof(ThresholdRun, masking) == 48 && offsetof(ThresholdRun, bands) == 64);
#endif
const uint kThresholdRunBlock = 0u;
const uint kThresholdPlacesBuffer = 2u;
const uint kThresholdTablesBuffer = 0u;
const uint kThresholdElevationsBuffer = 3u;
// Cells of the tables: 250 a decade from 1e-4 cd/m2, and behind them, for castleCSF, those of equal steps of
// the kKinkExponent-th power of the distance to its kink, up to the end of a cell of the others, which they
// replace.
const int kThresholdCells = 2500;
const int kThresholdKinkCells = 128;
const float kKinkCdM2 = 0.0112770204f;     // castleKinkCdM2()
const float kKinkEndCdM2 = 0.0141905752f;  // 10^(-4 + 538 / 250)
const float kKinkExponent = 0.1898f;       // kCastleKinkExponent

// Luminance.
const int kThresholdGroupSide = 16;  // of the passes without tiles
const uint kLuminanceSourceUnit = 0u;
const uint kLuminanceImage = 0u;

// Mean luminance, about which the nine fetches of 16 bits store theirs.
const int kThresholdMeanThreads = 256;
const uint kThresholdMeanBuffer = 5u;

// A coarser level by nine fetches.
const uint kNineFetchSourceUnit = 0u;
const uint kNineFetchCoarserImage = 0u;

// A coarser level, and a band or luminance.
const uint kCoarsenSourceUnit = 0u;
const uint kCoarsenCoarserImage = 0u;
const uint kCoarsenBandImage = 1u;
const uint kCoarsenRestImage = 2u;
const float kRestScale = 16777216.0f;  // what rounding takes from a float, over the float, is up to 2^-24

// Up to three coarser levels.
const uint kCoarsenManyCoarser2Image = 1u;
const uint kCoarsenManyCoarser3Image = 2u;

// Thresholds. Most samples around a tile at levels 1, 2 ...
#define LIMEN_MOST_SAMPLE_COLUMNS 36, 20, 12, 8, 6, 5, 5, 5
#define LIMEN_MOST_SAMPLE_ROWS 20, 12, 8, 6, 5, 5, 5, 5
const uint kEvaluateFinestUnit = 0u;
const uint kEvaluateGaussianUnit = 1u;
const uint kEvaluateRestUnit = 2u;
const uint kEvaluateImage = 0u;
const uint kEvaluateStagesImage = 1u;
const uint kEvaluatePatchesBuffer = 1u;
const uint kEvaluateTapsBuffer = 4u;

// Copy, as the benchmark's yardstick.
const int kCopyGroupX = 32;
const int kCopyGroupY = 8;
const uint kCopySourceUnit = 0u;
const uint kCopyImage = 0u;

#ifdef __cplusplus
}  // namespace limen::perception
#endif

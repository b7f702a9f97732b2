// SPDX-License-Identifier: BSD-3-Clause
// What the shaders of thresholds by band are bound to. For C++ and GLSL.
#pragma once

#include "renderer/gl/shader_shared.h"

#ifdef __cplusplus
namespace limen::perception {
#endif

// Tables of the model: lg luminance from kBandLgLow in cells of 1 / kBandCellsPerDecade, for each band; then
// the step over normalised contrast, kBandSegments per octave from 2^kBandLowOctave, as (value, rise).
const float kBandLgLow = -4.0f;
const int kBandCellsPerDecade = 1000;
const int kBandCells = 10000;
const int kBandSegmentBits = 5;
const int kBandSegments = 1 << kBandSegmentBits;
const int kBandLowOctave = -20;
const int kBandOctaves = 64;
const uint kBandSensitivitiesBuffer = 0u;
const uint kBandStepsBuffer = 1u;

// A level from the finer one, of kBandReduceTile samples.
const int kBandReduceX = 32;
const int kBandReduceY = 8;
const uint kBandReduceSourceUnit = 0u;
const uint kBandReduceFineImage = 0u;  // luminance, by the first pass
const uint kBandReduceCoarserImage = 1u;

// Thresholds of a band.
const int kBandTileX = 64;
const int kBandTileY = 32;
const int kBandThreads = 512;
const uint kBandLevelsUnit = 0u;
const uint kBandCoarserUnit = 1u;  // combined thresholds of the next band
const uint kBandCombinedImage = 0u;
const uint kBandOwnImage = 1u;

// One band's thresholds at full size.
const uint kBandEnlargeSourceUnit = 0u;
const uint kBandEnlargeImage = 0u;

#ifdef __cplusplus
}  // namespace limen::perception
#endif

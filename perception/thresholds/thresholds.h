// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "perception/multiscale/plane.h"
#include "perception/thresholds/settings.h"
#include "perception/vision/display.h"

namespace limen::perception {

struct Thresholds {
  Plane thresholdCdM2;
  int64_t guarded = 0;  ///< contrasts whose denominator was too small
};

/// Thresholds of either kind in double precision, without tables: see computeThresholdMap() and
/// computeBandThresholds(). Throws Error on unusable settings.
Thresholds computeThresholds(const Plane& luminanceCdM2, const DisplayProfile& display,
                             const ThresholdSettings& settings);

}  // namespace limen::perception

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/base/image.h"
#include "perception/multiscale/plane.h"
#include "perception/threshold_maps/settings.h"
#include "perception/vision/display.h"

namespace limen::perception {

/// A threshold map with its intermediate results; all planes have the image's size.
struct ThresholdMap {
  Plane thresholdCdM2;  ///< dL, which the thesis takes for the threshold of differences of any frequencies
  Plane adaptationCdM2;
  Plane elevation;               ///< S
  std::vector<Plane> contrasts;  ///< |c_i|, finest band first
  std::vector<Plane> levels;     ///< Gaussian levels as sampled
  int64_t guarded = 0;           ///< contrasts, over all bands, whose denominator was too small
};

/// The double-precision reference; deterministic, without tables. One threshold for all frequencies: by the
/// popping predictor, differences below it can be plainly visible. See computeBandThresholds() for those that
/// are not. `luminanceCdM2` may contain anything: NaN
/// and negative values count as 0, others up to settings.largestCdM2. Settings of the GPU alone are ignored.
/// Throws Error on unknown models or a display without pixels per degree.
ThresholdMap computeThresholdMap(const Plane& luminanceCdM2, double pixelsPerDegree,
                                 const ThresholdMapSettings& settings);

/// Luminance on a display of linear RGB (3 or 4 channels), or of one channel as is.
Plane luminancePlane(const Image& linear, const DisplayProfile& display);
/// Rounded to floats, one channel.
Image toImage(const Plane& plane);

/// Share of the pixels at which two maps disagree on a luminance difference: |dY| is above one threshold but
/// not the other. All have the same size.
double decisionFlips(const Plane& thresholdA, const Plane& thresholdB, const Plane& differenceCdM2);

}  // namespace limen::perception

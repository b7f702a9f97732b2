// SPDX-License-Identifier: BSD-3-Clause
#include "perception/thresholds/thresholds.h"

#include <utility>

#include "perception/band_thresholds/reference.h"
#include "perception/threshold_maps/reference.h"

namespace limen::perception {

Thresholds computeThresholds(const Plane& luminanceCdM2, const DisplayProfile& display,
                             const ThresholdSettings& settings) {
  if (const auto* single = std::get_if<ThresholdMapSettings>(&settings)) {
    ThresholdMap map = computeThresholdMap(luminanceCdM2, display.pixelsPerDegree(), *single);
    return {std::move(map.thresholdCdM2), map.guarded};
  }
  const auto& bands = std::get<BandThresholdSettings>(settings);
  const BandThresholds thresholds = computeBandThresholds(luminanceCdM2, display, bands);
  return {thresholdMapOf(thresholds, bands), thresholds.guarded};
}

}  // namespace limen::perception

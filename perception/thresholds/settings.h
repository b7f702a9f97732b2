// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "perception/band_thresholds/settings.h"
#include "perception/threshold_maps/settings.h"

/// The choice that everything offers that needs a luminance threshold for each pixel: `thresholds: bands`,
/// below which differences are not seen by the predictor, or `thresholds: single`, the map of Schwarz 2009,
/// section 9.4, for comparison.
namespace limen::perception {

using ThresholdSettings = std::variant<BandThresholdSettings, ThresholdMapSettings>;

/// The single map, with how the GPU computes it.
struct SingleOnGpu {
  static constexpr const char *kKind = ThresholdMapSettings::kKind,
                              *kSummary = ThresholdMapSettings::kSummary;
  ThresholdMapSettings map;
  ThresholdMapGpuSettings gpu;
  static const SettingsTable<SingleOnGpu>& table();
};

using ThresholdGpuSettings = std::variant<BandThresholdSettings, SingleOnGpu>;

/// What they mean wherever they are computed.
ThresholdSettings modelOf(const ThresholdGpuSettings& settings);
inline ThresholdSettings modelOf(const ThresholdSettings& settings) { return settings; }

/// Of the parameter `thresholds`, for all that declare it.
inline constexpr const char* kThresholdsText =
    "Luminance thresholds: by frequency band, or the thesis's single map, below which differences may be "
    "visible";

}  // namespace limen::perception

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perception/metrics/comparison.h"
#include "perception/popping/settings.h"
#include "perception/threshold_maps/viewing.h"

namespace limen::perception {

/// How products are shown to the viewer for whom differences are predicted.
struct ShownSettings {
  double exposure = 1.0;  ///< factor on the light; 1: light of 1 is the display's white
  /// Visibility and light colour are shown on the scene's surfaces: ambient * albedo + diffuse * albedo *
  /// cosine * product. These are the shares of frame::ShadedSetting.
  double ambient = 0.2, diffuse = 0.8;
  double background = 0.05;  ///< light where there is no surface
  static const SettingsTable<ShownSettings>& table();
};

/// What all JND metrics have in common.
struct JndSettings {
  ViewingSettings viewing{{"desktop_24", {}}};
  ShownSettings shown;
  ComparedRegion region;
  PoppingSettings predictor;
  static const SettingsTable<JndSettings>& table();
};

}  // namespace limen::perception

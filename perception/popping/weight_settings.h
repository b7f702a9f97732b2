// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"

namespace limen::perception {

/// Weight of a pixel's difference by how visible it was in the previous frame. Schwarz 2009, section
/// 10.3.4.
struct DisocclusionSettings {
  static constexpr const char *kKind = "weighted", *kSummary = "by what was hidden in the previous frame";
  double outsideVisibility = 0.0;  ///< of a pixel whose previous position lies outside the frame
  int pcfRadiusPx = 0;             ///< taps of the depth comparison: (2 r + 1)^2 positions, four texels each
  double depthTolerance = 0.01;    ///< relative difference of linear depth that is still the same surface
  static const SettingsTable<DisocclusionSettings>& table();
};

/// Flicker: dE94 over time >= kappa * dE94 between the levels of detail, unless the pixel moves. Schwarz
/// 2009, section 10.3.5.
struct FlickerSettings {
  static constexpr const char *kKind = "weighted", *kSummary = "by what changes over time anyway";
  double kappa = 0.9;
  double maxDisplacementPx = 8.0;  ///< a pixel that moves by this much or more does not flicker
  double weight = 0.25;            ///< of a flickering pixel
  double depthTolerance = 0.01;    ///< relative difference of linear depth that is still the same surface
  static const SettingsTable<FlickerSettings>& table();
};

struct IgnoredWeight {
  static constexpr const char *kKind = "ignored", *kSummary = "not at all";
};

}  // namespace limen::perception

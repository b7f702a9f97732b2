// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "perception/popping/settings.h"

namespace limen::perception {

inline constexpr int kMostReach = 4;

/// Settings of thresholds by frequency band, which invert the popping predictor.
struct BandThresholdSettings {
  /// The predictor whose responses must not change visibly. Its weights, regions and ratings are not used.
  PoppingSettings predictor;
  /// Largest change of a band's response that counts as invisible [JND].
  double jnd = 1.0;
  /// For the combined map: samples of a level, on each side, that a difference at one place reaches. A
  /// difference of unknown spectrum is spread by the filters of the bands.
  int reach = 3;
  static const SettingsTable<BandThresholdSettings>& table();
  /// Throws Error on what has no per-band thresholds: a stack in place of the pyramid.
  void check() const;
};

}  // namespace limen::perception

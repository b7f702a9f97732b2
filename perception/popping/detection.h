// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/settings_table.h"

namespace limen::perception {

/// Probability that a viewer who attends to a popping region reports it, as a function of its rating R:
/// P(R) = g + (1 - g - l) / (1 + exp(-(R - m) / s)). The only place of these four numbers; they are defaults
/// derived from what Schwarz 2009 prints (see detection.cpp) until a study's answers are fitted.
struct DetectionModel {
  double guessRate = 0.0446;  ///< g: reports without popping
  double lapseRate = 0.02;    ///< l: missed regardless of R
  double midpointR = 2.0;     ///< m
  double scaleR = 0.45512;    ///< s

  /// In [g, 1 - l]; R = -infinity (no region) gives g, NaN counts as -infinity.
  double probability(double rating) const;
  /// R for a probability; outside (g, 1 - l): minus or plus infinity.
  double rating(double probability) const;
  /// That at least one of several independent events is reported, guessing once.
  double probabilityOfAny(const std::vector<double>& ratings) const;

  static const SettingsTable<DetectionModel>& table();
};

}  // namespace limen::perception

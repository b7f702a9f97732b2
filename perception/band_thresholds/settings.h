// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "perception/popping/settings.h"

namespace limen::perception {

inline constexpr int kMostReach = 4;

// What a map of one value per pixel contains.
struct CombinedOutput {
  static constexpr const char *kKind = "combined",
                              *kSummary =
                                  "the smallest over the bands, safe for differences of any frequencies";
};
struct BandOutput {
  static constexpr const char *kKind = "band",
                              *kSummary = "those of one band, for differences split into bands";
  int band = 1;  ///< 0: the finest
  static const SettingsTable<BandOutput>& table();
};

/// Settings of thresholds by frequency band, which invert the popping predictor.
struct BandThresholdSettings {
  static constexpr const char *kKind = "bands",
                              *kSummary =
                                  "the popping predictor inverted in each frequency band: what stays below "
                                  "it is not seen";
  /// The predictor whose responses must not change visibly. Its model over time, weights, regions and ratings
  /// are not used: pictures last and the eye fixates.
  PoppingSettings predictor;
  /// Largest change of a band's response that counts as invisible [JND].
  double jnd = 1.0;
  /// For the combined map: samples of a level, on each side, that a difference at one place reaches. A
  /// difference of unknown spectrum is spread by the filters of the bands.
  int reach = 3;
  std::variant<CombinedOutput, BandOutput> output;
  static const SettingsTable<BandThresholdSettings>& table();
  /// Throws Error on what has no per-band thresholds: a stack in place of the pyramid, fitted weights,
  /// masking by neighbours.
  void check() const;
  /// Throws Error if the output is a band beyond the `bands` that there are.
  void checkBand(int bands) const;
};

}  // namespace limen::perception

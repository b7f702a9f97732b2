// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "renderer/frame/prefiltered_map.h"
#include "renderer/techniques/soft_shadows/map_settings.h"

namespace limen::techniques {

/// Averaging window of fixed size.
struct FixedWindow {
  static constexpr const char *kKind = "fixed", *kSummary = "of fixed size";
  double radius = 4.0;  ///< texels
  static const SettingsTable<FixedWindow>& table();
};

/// Window of the same size as for percentage-closer soft shadows, with blockers found by taps.
struct SearchedWindow {
  static constexpr const char *kKind = "searched",
                              *kSummary = "by the blockers' average depth, searched by taps";
  double scale = 1.0;  ///< share of the light's extents
  int taps = 8;        ///< per side
  static const SettingsTable<SearchedWindow>& table();
};

/// The same, with the blockers' average depth taken from averages of the map.
struct ConvolvedWindow {
  static constexpr const char *kKind = "convolved",
                              *kSummary = "by the blockers' average depth, from averages of the map";
  double scale = 1.0;       ///< share of the light's extents
  double threshold = 0.05;  ///< smallest blocking share of the window that counts as a blocker
  static const SettingsTable<ConvolvedWindow>& table();
};

using AnyWindow = std::variant<SearchedWindow, ConvolvedWindow, FixedWindow>;

/// How the sums of a summed-area table are stored.
struct FloatSums {
  static constexpr const char *kKind = "float", *kSummary = "32-bit floats";
};
struct FloatMeanSums {
  static constexpr const char *kKind = "float_mean", *kSummary = "32-bit floats of values less their mean";
};
struct FixedSums {
  static constexpr const char *kKind = "fixed", *kSummary = "32-bit whole numbers";
  int bits = 0;  ///< of a value; 0: as many as cannot overflow
  static const SettingsTable<FixedSums>& table();
};

/// The structure for averages.
struct SumsPrefilter {
  static constexpr const char *kKind = "sums", *kSummary = "summed-area table: any rectangle";
  std::variant<FloatSums, FloatMeanSums, FixedSums> form;
  static const SettingsTable<SumsPrefilter>& table();
};
struct MipsPrefilter {
  static constexpr const char *kKind = "mips", *kSummary = "pyramid: squares of the window's area";
};

/// Common settings, besides the window, of all techniques that average a shadow map; included in theirs.
struct PrefilteredSettings {
  MapSettings map = {};
  SlopeBias bias = {};
  std::variant<SumsPrefilter, MipsPrefilter> prefilter = {};
  static const SettingsTable<PrefilteredSettings>& table();
  /// Throws Error if values of this many bits need sums of more than 32.
  void check() const;

  /// Map, averaging structure, form of the sums.
  frame::PrefilterSettings prefilterSettings() const;
};

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "renderer/frame/prefiltered_map.h"
#include "renderer/techniques/soft_shadows/map_settings.h"

namespace limen::techniques {

/// Window of fixed size that is averaged.
struct FixedWindow {
  static constexpr const char *kKind = "fixed", *kSummary = "of fixed size";
  double radius = 4.0;  ///< texels
  static const SettingsTable<FixedWindow>& table();
};

/// Window as wide as percentage-closer soft shadows have it, the blockers being found by taps.
struct SearchedWindow {
  static constexpr const char *kKind = "searched",
                              *kSummary = "by the blockers' average depth, searched by taps";
  double scale = 1.0;  ///< share of the light's extents
  int taps = 8;        ///< along a side
  static const SettingsTable<SearchedWindow>& table();
};

/// The same, the blockers' average depth being an average of the map.
struct ConvolvedWindow {
  static constexpr const char *kKind = "convolved",
                              *kSummary = "by the blockers' average depth, from averages of the map";
  double scale = 1.0;       ///< share of the light's extents
  double threshold = 0.05;  ///< share of the window that must block before there is a blocker
  static const SettingsTable<ConvolvedWindow>& table();
};

using AnyWindow = std::variant<SearchedWindow, ConvolvedWindow, FixedWindow>;

/// How the sums of a summed-area table are held.
struct FloatSums {
  static constexpr const char *kKind = "float", *kSummary = "32-bit floats";
};
struct FloatMeanSums {
  static constexpr const char *kKind = "float_mean", *kSummary = "32-bit floats of values less their mean";
};
struct FixedSums {
  static constexpr const char *kKind = "fixed", *kSummary = "32-bit whole numbers";
  int bits = 0;  ///< of a value; 0: as many as never overflow
  static const SettingsTable<FixedSums>& table();
};

/// What averages are taken from.
struct SumsPrefilter {
  static constexpr const char *kKind = "sums", *kSummary = "summed-area table: any rectangle";
  std::variant<FloatSums, FloatMeanSums, FixedSums> form;
  static const SettingsTable<SumsPrefilter>& table();
};
struct MipsPrefilter {
  static constexpr const char *kKind = "mips", *kSummary = "pyramid: squares of the window's area";
};

/// What all techniques that average a shadow map have beside their windows; included in their settings.
struct PrefilteredSettings {
  MapSettings map = {};
  SlopeBias bias = {};
  std::variant<SumsPrefilter, MipsPrefilter> prefilter = {};
  static const SettingsTable<PrefilteredSettings>& table();
  /// Throws Error if values of so many bits need sums of more than 32.
  void check() const;

  /// Map, way of averaging, form of the sums.
  frame::PrefilterSettings prefilterSettings() const;
};

}  // namespace limen::techniques

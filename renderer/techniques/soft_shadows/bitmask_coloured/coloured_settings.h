// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/bitmask/bitmask_settings.h"

namespace limen::techniques {

/// Patterns whose light samples represent cells of the light.
template <LightPattern P>
struct CellSamples {
  static constexpr LightPattern kPattern = P;
  static constexpr const char *kKind = limen::toText(P), *kSummary = "";
  bool prefilter = true;
  static const SettingsTable<CellSamples>& table();
};
using ColouredPattern =
    std::variant<CellSamples<LightPattern::Regular8>, CellSamples<LightPattern::Regular16>,
                 CellSamples<LightPattern::Regular32>, CellSamples<LightPattern::Jittered16>,
                 RandomSamples<LightPattern::Random128>, RandomSamples<LightPattern::Random256>,
                 RandomSamples<LightPattern::Random1024>, RandomSamples<LightPattern::Stratified256>,
                 HaltonSamples<LightPattern::Halton256>>;

struct ColourMasks {
  static constexpr const char *kKind = "masks", *kSummary = "a mask for each colour";
};
struct ColourTable {
  static constexpr const char *kKind = "table", *kSummary = "a table of sums for groups of samples";
  int groupBits = 8;
  static const SettingsTable<ColourTable>& table();
};
struct ColourSamples {
  static constexpr const char *kKind = "samples", *kSummary = "one sample after another";
};
using ColourSums = std::variant<ColourMasks, ColourTable, ColourSamples>;

/// Colours follow from the masks of all pixels: one level per pixel.
struct ColouredSettings {
  SearchSettings search = {};
  WholeLevelSettings levels = {};
  PassSettings passes = SplitPasses{};
  MaskedOccluders occluders = {};
  ColouredPattern pattern = CellSamples<LightPattern::Jittered16>{};
  MapChoice maps = {};
  ColourSums colours = ColourTable{};
  static const SettingsTable<ColouredSettings>& table();
  void check() const;
  /// Samples emit the mean over their cell of the light.
  bool prefilters() const;
};

template <LightPattern P>
const SettingsTable<CellSamples<P>>& CellSamples<P>::table() {
  static const SettingsTable<CellSamples> kTable = {
      Binding(&CellSamples::prefilter, "prefilter",
              "Samples emit the mean over their cell of the light, not the emission at their position")
          .formerly({"prefilter"})};
  return kTable;
}

}  // namespace limen::techniques

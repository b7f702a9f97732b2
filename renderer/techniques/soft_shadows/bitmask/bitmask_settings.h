// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/bitmask/light_maps.h"
#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"
#include "renderer/techniques/soft_shadows/bitmask/visibility_filter.h"
#include "renderer/techniques/soft_shadows/search_settings.h"

namespace limen::techniques {

struct ApproximateMask {
  static constexpr const char *kKind = "approximate",
                              *kSummary = "samples of a rectangle in place of the quad";
};
struct HalfSpaceTable {
  static constexpr const char *kKind = "half_space_table",
                              *kSummary = "samples of the convex hull by a table of half-spaces";
  int size = 256;  ///< angles, and distances, of lines
  static const SettingsTable<HalfSpaceTable>& table();
};
struct ArithmeticMask {
  static constexpr const char *kKind = "arithmetic",
                              *kSummary = "samples of the convex hull, row by row of a grid";
};

struct MaskedMicroquads : OccluderAlternative<OccluderKind::Microquads> {
  static constexpr const char* kSummary = "a mesh between texel centres";
  CoarseDepths depths = CoarseDepths::Nearest;
  std::variant<ApproximateMask, HalfSpaceTable, ArithmeticMask> mask;
  static const SettingsTable<MaskedMicroquads>& table();
};
/// A rectangle cannot approximate a triangle.
struct MaskedMicrotris : OccluderAlternative<OccluderKind::MicroquadsMicrotris> {
  static constexpr const char* kSummary = "that mesh with triangles where three of four texels block";
  CoarseDepths depths = CoarseDepths::Nearest;
  std::variant<ArithmeticMask, HalfSpaceTable> mask;
  static const SettingsTable<MaskedMicrotris>& table();
};
using MaskedOccluders = std::variant<Micropatches, MaskedMicroquads, MaskedMicrotris, Microrects>;

/// Patterns of light samples as alternatives; those on grids have no parameters.
template <LightPattern P>
struct GridSamples {
  static constexpr LightPattern kPattern = P;
  static constexpr const char *kKind = limen::toText(P), *kSummary = "";
};
/// Steps per axis of the rectangle table for patterns without a grid.
template <LightPattern P>
struct HaltonSamples {
  static constexpr LightPattern kPattern = P;
  static constexpr const char *kKind = limen::toText(P), *kSummary = "";
  int rectangleTable = 128;
  static const SettingsTable<HaltonSamples>& table();
};
template <LightPattern P>
struct RandomSamples {
  static constexpr LightPattern kPattern = P;
  static constexpr const char *kKind = limen::toText(P), *kSummary = "";
  int64_t seed = 1;
  int rectangleTable = 128;
  static const SettingsTable<RandomSamples>& table();
};
using PatternSettings =
    std::variant<GridSamples<LightPattern::Regular8>, GridSamples<LightPattern::Regular16>,
                 GridSamples<LightPattern::Regular32>, GridSamples<LightPattern::Jittered16>,
                 RandomSamples<LightPattern::Random128>, RandomSamples<LightPattern::Random256>,
                 RandomSamples<LightPattern::Random1024>, RandomSamples<LightPattern::Stratified256>,
                 HaltonSamples<LightPattern::Halton256>>;

/// What masks need to know about the chosen pattern.
struct SampleChoice {
  LightPattern pattern = LightPattern::Jittered16;
  int64_t seed = 1;
  int rectangleTable = 128;  ///< of patterns without a grid
};
template <class... A>
SampleChoice sampleChoice(const std::variant<A...>& pattern) {
  return std::visit(
      [](const auto& chosen) {
        SampleChoice choice{.pattern = chosen.kPattern};
        if constexpr (requires { chosen.seed; }) choice.seed = chosen.seed;
        if constexpr (requires { chosen.rectangleTable; }) choice.rectangleTable = chosen.rectangleTable;
        return choice;
      },
      pattern);
}

/// How the mask of a quad is found; the order is that of quad_mask.glsl.
enum class QuadMask { Approximate, HalfSpaceTable, Arithmetic };
constexpr EnumNames<QuadMask, 3> enumNames(QuadMask) {
  return {{{{QuadMask::Approximate, ApproximateMask::kKind},
            {QuadMask::HalfSpaceTable, HalfSpaceTable::kKind},
            {QuadMask::Arithmetic, ArithmeticMask::kKind}}}};
}
struct QuadMaskChoice {
  QuadMask mask = QuadMask::Approximate;
  int tableSize = 256;
};
QuadMaskChoice quadMaskChoice(const MaskedOccluders& occluders);

/// Throws Error if masks cannot be found for the samples.
void checkSamples(const MaskedOccluders& occluders, LightPattern pattern);
/// Throws Error if several maps are requested with a setting that supports only one.
void checkMaps(const MapChoice& maps, const SearchSettings& search);

struct BitmaskSettings {
  SearchSettings search = {};
  LevelSettings levels = {};
  PassSettings passes = SplitPasses{};
  MaskedOccluders occluders = {};
  PatternSettings pattern = GridSamples<LightPattern::Jittered16>{};
  MapChoice maps = {};
  FilterSettings filter = {};
  static const SettingsTable<BitmaskSettings>& table();
  void check() const;
};

/// The bindings that techniques with masks share.
template <class S>
Binding<S> maskedOccludersBinding(MaskedOccluders S::*member) {
  return {member, "occluders", "Type of micro-occluder made from blocking texels",
          "Schwarz 2009, sections 4.1, 4.4.1, 4.4.3 and 4.5.1"};
}
template <class S>
Binding<S> mapsBinding(MapChoice S::*member) {
  return {member, "maps", "Shadow maps whose occluders are combined", "Schwarz 2009, section 4.2.2"};
}
template <class S, class P>
Binding<S> patternBinding(P S::*member) {
  return {member, "pattern",
          "Light samples: regular grids, 16 x 16 in rotated pairs, or positions without a grid",
          "Schwarz 2009, sections 4.2.1 and 4.2.2"};
}
template <class S>
Binding<S> rectangleTableBinding(int S::*member) {
  return Binding(member, "rectangle_table", oneOf({16, 32, 64, 128, 256}), "",
                 "Steps per axis of the rectangle table",
                 "Schwarz 2009, section 4.2.1 (value not given there)")
      .formerly({"rectangle_table"});
}

template <LightPattern P>
const SettingsTable<HaltonSamples<P>>& HaltonSamples<P>::table() {
  static const SettingsTable<HaltonSamples> kTable = {rectangleTableBinding(&HaltonSamples::rectangleTable)};
  return kTable;
}
template <LightPattern P>
const SettingsTable<RandomSamples<P>>& RandomSamples<P>::table() {
  static const SettingsTable<RandomSamples> kTable = {
      Binding(&RandomSamples::seed, "seed", Range{0, 1000000}, "", "Seed of the sample positions")
          .formerly({"pattern_seed"}),
      rectangleTableBinding(&RandomSamples::rectangleTable)};
  return kTable;
}

}  // namespace limen::techniques

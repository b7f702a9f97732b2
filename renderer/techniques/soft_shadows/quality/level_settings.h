// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/settings_table.h"

namespace limen::techniques {

/// Source of a pixel's real-valued level.
enum class LevelSource { SearchArea, FilteredDepth };
constexpr EnumNames<LevelSource, 2> enumNames(LevelSource) {
  return {{{{LevelSource::SearchArea, "search_area"}, {LevelSource::FilteredDepth, "filtered_depth"}}}};
}

/// How a level is chosen, as in level_of_quality.glsl.
enum class LevelRule { FinestWithin, CoarsestOver, Blend, NarrowBlend, Dither };
constexpr EnumNames<LevelRule, 5> enumNames(LevelRule) {
  return {{{{LevelRule::FinestWithin, "finest_within"},
            {LevelRule::CoarsestOver, "coarsest_over"},
            {LevelRule::Blend, "blend"},
            {LevelRule::NarrowBlend, "narrow_blend"},
            {LevelRule::Dither, "dither"}}}};
}

struct FinestWithin {
  static constexpr const char *kKind = "finest_within", *kSummary = "the finest within the budget";
  static constexpr LevelRule kRule = LevelRule::FinestWithin;
};
struct CoarsestOver {
  static constexpr const char *kKind = "coarsest_over",
                              *kSummary = "the floor of the real-valued level, which exceeds the budget";
  static constexpr LevelRule kRule = LevelRule::CoarsestOver;
  LevelSource source = LevelSource::SearchArea;
  static const SettingsTable<CoarsestOver>& table();
};
struct BlendedLevels {
  static constexpr const char *kKind = "blend", *kSummary = "both levels around the real-valued one, blended";
  static constexpr LevelRule kRule = LevelRule::Blend;
  LevelSource source = LevelSource::SearchArea;
  static const SettingsTable<BlendedLevels>& table();
};
struct NarrowlyBlendedLevels {
  static constexpr const char *kKind = "narrow_blend", *kSummary = "both, blended only over a narrow zone";
  static constexpr LevelRule kRule = LevelRule::NarrowBlend;
  LevelSource source = LevelSource::SearchArea;
  double width = 0.1;
  static const SettingsTable<NarrowlyBlendedLevels>& table();
};
struct DitheredLevels {
  static constexpr const char *kKind = "dither",
                              *kSummary = "one of the two around the real-valued one, at random";
  static constexpr LevelRule kRule = LevelRule::Dither;
  LevelSource source = LevelSource::SearchArea;
  static const SettingsTable<DitheredLevels>& table();
};
/// Levels that do not depend on a budget.
struct FixedLevel {
  static constexpr const char *kKind = "fixed", *kSummary = "the same for all pixels, whatever the budget";
  static constexpr LevelRule kRule = LevelRule::FinestWithin;
  int level = 0;
  static const SettingsTable<FixedLevel>& table();
};

/// Level of the pyramid used for a pixel's micro-occluders. Source: Schwarz 2009, sections 4.5, 5.2.1
/// and 5.2.2 (formula reconstructed).
using LevelSettings = std::variant<FinestWithin, CoarsestOver, BlendedLevels, NarrowlyBlendedLevels,
                                   DitheredLevels, FixedLevel>;
/// Those with one integer level per pixel.
using WholeLevelSettings = std::variant<FinestWithin, CoarsestOver, FixedLevel>;

LevelSettings anyLevels(const WholeLevelSettings& levels);
LevelRule ruleOf(const LevelSettings& levels);
LevelSource sourceOf(const LevelSettings& levels);

/// Order in which split passes process pixels.
enum class WorkOrder {
  Tiles,      ///< of the image
  LoopLength  ///< those with the longest loops over micro-occluders first
};
constexpr EnumNames<WorkOrder, 2> enumNames(WorkOrder) {
  return {{{{WorkOrder::Tiles, "tiles"}, {WorkOrder::LoopLength, "loop_length"}}}};
}

struct LevelFilter {
  static constexpr const char *kKind = "filter", *kSummary = "a filter over neighbours of similar depth";
  int radius = 5;  ///< px: half of the support, excluding the centre
  double sigma = 3.0, depthThreshold = 0.02;
  static const SettingsTable<LevelFilter>& table();
};
struct NoSmoothing {
  static constexpr const char *kKind = "none", *kSummary = "levels as chosen";
};

struct SinglePass {
  static constexpr const char *kKind = "single", *kSummary = "all work on a pixel in one pass";
};
struct SplitPasses {
  static constexpr const char
      *kKind = "split",
      *kSummary = "search, smoothing of levels and the loop over micro-occluders in separate passes";
  WorkOrder order = WorkOrder::Tiles;
  int lanes = 4;  ///< invocations that share a pixel's loop
  std::variant<LevelFilter, NoSmoothing> smoothing;
  static const SettingsTable<SplitPasses>& table();
};
using PassSettings = std::variant<SinglePass, SplitPasses>;

/// The bindings of `levels` and `passes`, the same for all techniques that have them.
template <class S, class L>
Binding<S> levelsBinding(L S::*member) {
  return Binding(member, "levels", "Level of the shadow map used for micro-occluders",
                 "Schwarz 2009, sections 4.5, 5.2.1 and 5.2.2 (formula reconstructed)")
      .formerly({"fixed_level"});
}
template <class S>
Binding<S> passesBinding(PassSettings S::*member) {
  return {member, "passes", "Passes in which pixels are searched and gathered",
          "Schwarz 2009, sections 4.1 and 5.2.1"};
}

}  // namespace limen::techniques

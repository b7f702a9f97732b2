// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/level_settings.h"

namespace limen::techniques {
namespace {

constexpr double kCoarsest = 12.0;  // the only texel of the largest map

template <class S>
Binding<S> sourceBinding() {
  return Binding(&S::source, "source",
                 "Source of the real-valued level: the narrowed search area, or linearly filtered depths of "
                 "the pyramid",
                 "Schwarz 2009, section 5.2 (filtered_depth: after Guennebaud 2007)")
      .formerly({"level_source"});
}

}  // namespace

const SettingsTable<CoarsestOver>& CoarsestOver::table() {
  static const SettingsTable<CoarsestOver> kTable = {sourceBinding<CoarsestOver>()};
  return kTable;
}

const SettingsTable<BlendedLevels>& BlendedLevels::table() {
  static const SettingsTable<BlendedLevels> kTable = {sourceBinding<BlendedLevels>()};
  return kTable;
}

const SettingsTable<NarrowlyBlendedLevels>& NarrowlyBlendedLevels::table() {
  static const SettingsTable<NarrowlyBlendedLevels> kTable = {
      sourceBinding<NarrowlyBlendedLevels>(),
      Binding(&NarrowlyBlendedLevels::width, "width", Range{0.001, 1.0}, "level",
              "Width of the zone in which two levels are blended; 1 is a full blend",
              "Schwarz 2009, section 5.2.2")
          .formerly({"blend_width"})};
  return kTable;
}

const SettingsTable<DitheredLevels>& DitheredLevels::table() {
  static const SettingsTable<DitheredLevels> kTable = {sourceBinding<DitheredLevels>()};
  return kTable;
}

const SettingsTable<FixedLevel>& FixedLevel::table() {
  static const SettingsTable<FixedLevel> kTable = {
      Binding(&FixedLevel::level, "level", Range{0.0, kCoarsest}, "",
              "Level of the shadow map used for all micro-occluders", "Schwarz 2009, section 4.5")
          .formerly({"fixed_level"})};
  return kTable;
}

const SettingsTable<LevelFilter>& LevelFilter::table() {
  static const SettingsTable<LevelFilter> kTable = {
      Binding(&LevelFilter::radius, "radius", Range{1, 10}, "px", "Radius of the filter",
              "Schwarz 2009, section 5.2.2 (support 11 x 11)")
          .formerly({"smoothing_radius"}),
      Binding(&LevelFilter::sigma, "sigma", Range{0.1, 100.0}, "px",
              "Standard deviation of the filter's weights", "Schwarz 2009, section 5.2.1 (open there)")
          .formerly({"smoothing_sigma"}),
      Binding(&LevelFilter::depthThreshold, "depth_threshold", Range{0.0, 1.0}, "",
              "Depth step between pixels at which the filter stops, as a share of the depth",
              "Schwarz 2009, section 5.2.1 (open there)")
          .formerly({"depth_threshold"})};
  return kTable;
}

const SettingsTable<SplitPasses>& SplitPasses::table() {
  static const SettingsTable<SplitPasses> kTable = {
      Binding(&SplitPasses::order, "order",
              "Order of the pixels: by tiles of the image, or those with the longest loops over "
              "micro-occluders first",
              "Schwarz 2009, section 5.2.2 (coherence)")
          .formerly({"work_order"}),
      {&SplitPasses::lanes, "lanes", oneOf({1, 2, 4, 8, 16}), "",
       "Invocations that share the loop over a pixel's micro-occluders"},
      {&SplitPasses::smoothing, "smoothing",
       "Smoothing of real-valued levels, if two are blended or dithered", "Schwarz 2009, section 5.2.2"}};
  return kTable;
}

LevelSettings anyLevels(const WholeLevelSettings& levels) {
  return std::visit([](const auto& chosen) -> LevelSettings { return chosen; }, levels);
}

LevelRule ruleOf(const LevelSettings& levels) {
  return std::visit([](const auto& chosen) { return chosen.kRule; }, levels);
}

LevelSource sourceOf(const LevelSettings& levels) {
  return std::visit(
      [](const auto& chosen) {
        if constexpr (requires { chosen.source; })
          return chosen.source;
        else
          return LevelSource::SearchArea;
      },
      levels);
}

}  // namespace limen::techniques

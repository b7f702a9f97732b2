// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <variant>

#include "experiments/base/settings_table.h"
#include "renderer/frame/microrect_map.h"
#include "renderer/frame/sampled_pyramid.h"
#include "renderer/gl/program.h"

namespace limen::techniques {

/// Types of micro-occluder made from blocking texels. Sources: Schwarz 2009,
/// sections 4.1, 4.4.1, 4.4.3, 4.4.5, 4.5.1 and 5.1.2.
enum class OccluderKind {
  Micropatches,         ///< rectangles at one depth
  Microquads,           ///< a mesh between texel centres
  MicroquadsMicrotris,  ///< that with triangles where three of four block
  Contours,             ///< outlines of the texels that block
  Microrects,           ///< rectangles of their own extents
  MorphingMicroquads    ///< a mesh between two levels
};
constexpr EnumNames<OccluderKind, 6> enumNames(OccluderKind) {
  return {{{{OccluderKind::Micropatches, "micropatches"},
            {OccluderKind::Microquads, "microquads"},
            {OccluderKind::MicroquadsMicrotris, "microquads_microtris"},
            {OccluderKind::Contours, "contours"},
            {OccluderKind::Microrects, "microrects"},
            {OccluderKind::MorphingMicroquads, "morphing_microquads"}}}};
}

/// Neighbours to which a rectangle is stretched to close gaps.
enum class GapFill { None, LeftBottom, Diagonal, Limited };
constexpr EnumNames<GapFill, 4> enumNames(GapFill) {
  return {{{{GapFill::None, "none"},
            {GapFill::LeftBottom, "left_bottom"},
            {GapFill::Diagonal, "diagonal"},
            {GapFill::Limited, "limited"}}}};
}
struct NoFill {
  static constexpr GapFill kFill = GapFill::None;
  static constexpr const char *kKind = limen::toText(kFill), *kSummary = "gaps stay open";
};
struct LeftBottomFill {
  static constexpr GapFill kFill = GapFill::LeftBottom;
  static constexpr const char *kKind = limen::toText(kFill),
                              *kSummary = "stretched to the left and the lower neighbour";
};
struct DiagonalFill {
  static constexpr GapFill kFill = GapFill::Diagonal;
  static constexpr const char *kKind = limen::toText(kFill), *kSummary = "to the lower left one as well";
};
/// Gaps between surfaces that belong together are narrow; of wider ones, light that passes between two
/// surfaces is as likely as leaks. On the scenes of reference_results every limit errs and leaks more than
/// none.
struct LimitedFill {
  static constexpr GapFill kFill = GapFill::Limited;
  static constexpr const char *kKind = limen::toText(kFill),
                              *kSummary =
                                  "stretched to the left and the lower neighbour over narrow gaps only";
  double width = 0.25;  ///< of the light's
  static const SettingsTable<LimitedFill>& table();
};
using GapFillSettings = std::variant<LeftBottomFill, NoFill, DiagonalFill, LimitedFill>;

/// The depth that a texel of a coarse level stands for.
enum class CoarseDepths {
  Nearest,  ///< the nearest of the finest texels that it covers
  Sampled,  ///< that of one of them
  Centre,   ///< that of the one at its centre
  Median    ///< the second nearest of four of them
};
constexpr EnumNames<CoarseDepths, 4> enumNames(CoarseDepths) {
  return {{{{CoarseDepths::Nearest, "nearest"},
            {CoarseDepths::Sampled, "sampled"},
            {CoarseDepths::Centre, "centre"},
            {CoarseDepths::Median, "median"}}}};
}
/// The finest texel that a texel stands for; none for the nearest depths.
constexpr std::optional<frame::SampledTexel> sampledTexel(CoarseDepths depths) {
  switch (depths) {
    case CoarseDepths::Nearest:
      return std::nullopt;
    case CoarseDepths::Sampled:
      return frame::SampledTexel::Lattice;
    case CoarseDepths::Centre:
      return frame::SampledTexel::Centre;
    case CoarseDepths::Median:
      return frame::SampledTexel::Median;
  }
  return std::nullopt;
}

/// Division of a search area into micro-occluders.
struct AutoDivision {
  static constexpr const char *kKind = "auto",
                              *kSummary =
                                  "cells where they replace the finest level within the budget, depths "
                                  "are sampled and each is tested against the receiver's plane; levels "
                                  "otherwise";
};
struct LevelDivision {
  static constexpr const char *kKind = "levels",
                              *kSummary = "texels of a level, 1, 2, 4, ... of the map's on a side";
};
/// As many cells as a share of the budget allows, whatever the area's extent. Levels are powers of two, so on
/// average they use about half of a budget; by default cells use little more. Own form; no source.
struct SearchCells {
  static constexpr const char
      *kKind = "cells",
      *kSummary = "as many cells as a share of the budget allows, each with the depth of one texel";
  double middle = 0.75;     ///< width of the cells in the area's middle, as a share of the mean
  double leastWidth = 1.0;  ///< texels
  double spread = 0.6;      ///< of the texels that stand for cells, in widths of a cell about its middle
  double share = 0.6;       ///< of the budget, up to 1
  static const SettingsTable<SearchCells>& table();
  /// The uniforms of cell_grid.glsl, and leastWidth.
  void configure(const gl::Program& program) const;
};
/// The root of a budget, rounded down, as shaders take it; 0: no limit.
int allowedPerAxis(int64_t budget);
using DivisionSettings = std::variant<AutoDivision, LevelDivision, SearchCells>;

/// A kind of micro-occluder as an alternative of a technique's settings.
template <OccluderKind K>
struct OccluderAlternative {
  static constexpr OccluderKind kOccluders = K;
  static constexpr const char* kKind = limen::toText(K);
};

template <class S>
Binding<S> coarseDepthsBinding() {
  return {&S::depths, "depths",
          "Depth that a texel of a coarse level stands for: the nearest of the texels that it covers or, so "
          "that it "
          "hides as much of the light as they do on average, that of one of them, of the one at its centre, "
          "or the "
          "second nearest of four",
          "Schwarz 2009, section 4.1 (nearest); others: own forms"};
}

struct Micropatches : OccluderAlternative<OccluderKind::Micropatches> {
  static constexpr const char* kSummary = "texels as rectangles at one depth";
  CoarseDepths depths = CoarseDepths::Sampled;
  DivisionSettings division = AutoDivision{};
  GapFillSettings gapFill;
  static const SettingsTable<Micropatches>& table();
};

struct Microrects : OccluderAlternative<OccluderKind::Microrects> {
  static constexpr const char* kSummary = "rectangles of texels, of their own extents, at one depth";
  GapFillSettings gapFill;
  frame::MergeMetric mergeMetric = frame::MergeMetric::Absolute;
  frame::DiagonalMerge diagonalMerge = frame::DiagonalMerge::Contained;
  static const SettingsTable<Microrects>& table();
};

/// What a search needs to know about the chosen alternative.
struct OccluderChoice {
  OccluderKind kind = OccluderKind::Micropatches;
  CoarseDepths depths = CoarseDepths::Nearest;
  DivisionSettings division = LevelDivision{};
  GapFill gapFill = GapFill::LeftBottom;
  double gapWidth = 0.0;                  ///< that is filled, if limited, as a share of the light's width
  frame::MergeRule merge = {};            ///< of microrects
  std::optional<double> morphLevel = {};  ///< of morphing microquads

  void define(gl::ShaderDefines& defines) const {
    defineEnum(defines, "OCCLUDERS", kind);
    defineEnum(defines, "GAP_FILL", gapFill);
    if (const auto texel = sampledTexel(depths)) {
      defines["DEPTHS_SAMPLED"] = "1";
      defines.merge(frame::SampledTexelSetting{*texel}.defines());
    }
  }
};

template <class Alternative>
OccluderChoice occluderChoice(const Alternative& chosen) {
  OccluderChoice choice{.kind = Alternative::kOccluders};
  if constexpr (requires { chosen.depths; }) choice.depths = chosen.depths;
  if constexpr (requires { chosen.division; }) choice.division = chosen.division;
  if constexpr (requires { chosen.gapFill; })
    std::visit(
        [&](const auto& fill) {
          choice.gapFill = fill.kFill;
          if constexpr (requires { fill.width; }) choice.gapWidth = fill.width;
        },
        chosen.gapFill);
  if constexpr (requires { chosen.mergeMetric; }) choice.merge = {chosen.mergeMetric, chosen.diagonalMerge};
  if constexpr (requires { chosen.morphLevel; }) choice.morphLevel = chosen.morphLevel;
  return choice;
}
template <class... A>
OccluderChoice occluderChoice(const std::variant<A...>& occluders) {
  return std::visit([](const auto& chosen) { return occluderChoice(chosen); }, occluders);
}

}  // namespace limen::techniques

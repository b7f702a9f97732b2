// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/enum_names.h"
#include "experiments/base/settings_table.h"

namespace limen::many_lods {

/// Whether a list's order depends on nothing but the input.
enum class CutOrder {
  Free,  ///< a dispatch a step; where a list has no room, chance decides whose splits are refused
  Kept   ///< three dispatches a step
};
constexpr EnumNames<CutOrder, 2> enumNames(CutOrder) {
  return {{{{CutOrder::Free, "free"}, {CutOrder::Kept, "kept"}}}};
}
/// From the root in every frame. Source: Holländer 2013, section 3.5.2.
struct BasicCuts {
  static constexpr const char *kKind = "basic", *kSummary = "from the root in every frame";
  int arity = 2;
  int stepLevels = 3;
  CutOrder order = CutOrder::Free;
  static const SettingsTable<BasicCuts>& table();
};
/// From the cut of the frame before, until every node is right.
struct IncrementalCuts {
  static constexpr const char *kKind = "incremental", *kSummary = "from the last frame's cut, to the end";
  int arity = 2;
  int stepLevels = 3;
  CutOrder order = CutOrder::Free;
  bool margins = false;  ///< ListedCuts; of trees whose shape() knows how far they move
  static const SettingsTable<IncrementalCuts>& table();
};
/// From the cut of the frame before, by a few edges of the tree.
struct LazyCuts {
  static constexpr const char *kKind = "lazy", *kSummary = "from the last frame's cut, by a few edges";
  int arity = 2;
  int edges = 1;
  static const SettingsTable<LazyCuts>& table();
};
/// As LazyCuts by the listing as printed: it loses and doubles parts of the surface.
struct LiteralCuts {
  static constexpr const char *kKind = "literal",
                              *kSummary = "lazy by the printed listing, which breaks the cut";
  int arity = 2;
  int edges = 1;
  static const SettingsTable<LiteralCuts>& table();
};
/// Where cuts by geometry shaders start.
enum class FeedbackStart { LastCut, Root };
constexpr EnumNames<FeedbackStart, 2> enumNames(FeedbackStart) {
  return {{{{FeedbackStart::LastCut, "last_cut"}, {FeedbackStart::Root, "root"}}}};
}
/// By geometry shaders and transform feedback (feedback_cuts.h).
struct GeometryShaderCuts {
  static constexpr const char *kKind = "geometry_shader",
                              *kSummary = "to the end, by a geometry shader and transform feedback";
  FeedbackStart start = FeedbackStart::LastCut;
  static const SettingsTable<GeometryShaderCuts>& table();
};
/// The CPU walks the top of the tree, on all cores, and the GPU goes on from there.
struct TopOnCpu {
  static constexpr const char *kKind = "top", *kSummary = "the CPU walks the top of the tree";
  int levels = 8;
  static const SettingsTable<TopOnCpu>& table();
};
enum class CutProcessor { Gpu, Cpu, Both };
constexpr EnumNames<CutProcessor, 3> enumNames(CutProcessor) {
  return {{{{CutProcessor::Gpu, "gpu"}, {CutProcessor::Cpu, "cpu"}, {CutProcessor::Both, "both"}}}};
}
enum class CutSums { Gpu, Cpu };
constexpr EnumNames<CutSums, 2> enumNames(CutSums) {
  return {{{{CutSums::Gpu, "gpu"}, {CutSums::Cpu, "cpu"}}}};
}
/// In every step both do their part.
struct SharedSteps {
  static constexpr const char *kKind = "steps", *kSummary = "both do their part of every step";
  CutProcessor events = CutProcessor::Gpu;
  CutSums sums = CutSums::Cpu;
  int eventTasks = 1, sumTasks = 1;
  static const SettingsTable<SharedSteps>& table();
};
/// From the root, by CPU and GPU together (hybrid_cuts.h).
struct HybridSettings {
  static constexpr const char *kKind = "hybrid", *kSummary = "from the root, by CPU and GPU together";
  std::variant<TopOnCpu, SharedSteps> share;
  static const SettingsTable<HybridSettings>& table();
};
using CutMode =
    std::variant<IncrementalCuts, LazyCuts, BasicCuts, LiteralCuts, GeometryShaderCuts, HybridSettings>;

/// Whether the mode wants to know how far nodes move (GpuTree::keepTravel()).
bool wantsTravel(const CutMode& mode);

/// Of the tree as the mode walks it: nodes have 2^arityBitsOf() children. Those of a complete binary tree's
/// levels between are passed over.
int arityBitsOf(const CutMode& mode);

}  // namespace limen::many_lods

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/cut_mode.h"

#include <bit>
#include <cstdint>

#include "renderer/many_lods/many_lods_bindings.h"

namespace limen::many_lods {
namespace {

constexpr const char *kArityText =
                         "Children of a node: of 4 and 8 every second and third level of the tree is one",
                     *kAritySource = "Holländer 2013, section 3.8",
                     *kStepLevelsText =
                         "Levels of the tree by which an entry is split at once: fewer steps, "
                         "more work for one invocation",
                     *kOrderText = "Order of the list: free in one dispatch a step, or kept, in three";

template <class S>
const SettingsTable<S>& edgesTable() {
  static const SettingsTable<S> kTable = {
      {&S::arity, "arity", oneOf({2, 4, 8}), "", kArityText, kAritySource},
      {&S::edges,
       "edges",
       {1, 24},
       "",
       "Edges of the tree by which an entry may move in a frame",
       "Holländer 2013, section 3.5.2 (q)"}};
  return kTable;
}

}  // namespace

int arityBitsOf(const CutMode& mode) {
  return std::visit(
      [](const auto& form) -> int {
        if constexpr (requires { form.arity; })
          return static_cast<int>(std::bit_width(static_cast<uint32_t>(form.arity))) - 1;
        else
          return 1;
      },
      mode);
}

bool wantsTravel(const CutMode& mode) {
  const auto* incremental = std::get_if<IncrementalCuts>(&mode);
  return incremental && incremental->margins;
}

const SettingsTable<BasicCuts>& BasicCuts::table() {
  using S = BasicCuts;
  static const SettingsTable<S> kTable = {
      {&S::arity, "arity", oneOf({2, 4, 8}), "", kArityText, kAritySource},
      {&S::stepLevels, "step_levels", {1, kMostSplitLevels}, "", kStepLevelsText},
      {&S::order, "order", kOrderText}};
  return kTable;
}
const SettingsTable<IncrementalCuts>& IncrementalCuts::table() {
  using S = IncrementalCuts;
  static const SettingsTable<S> kTable = {
      {&S::arity, "arity", oneOf({2, 4, 8}), "", kArityText, kAritySource},
      {&S::stepLevels, "step_levels", {1, kMostSplitLevels}, "", kStepLevelsText},
      {&S::order, "order", kOrderText},
      {&S::margins, "margins",
       "Nodes are tested again only where eye or surface have moved farther than the last test left room "
       "for; "
       "the cut is the same. Of complete trees"}};
  return kTable;
}
const SettingsTable<LazyCuts>& LazyCuts::table() { return edgesTable<LazyCuts>(); }
const SettingsTable<LiteralCuts>& LiteralCuts::table() { return edgesTable<LiteralCuts>(); }
const SettingsTable<TopOnCpu>& TopOnCpu::table() {
  using S = TopOnCpu;
  static const SettingsTable<S> kTable = {
      {&S::levels, "levels", {0, 16}, "", "Levels of the tree below its root that the CPU walks"}};
  return kTable;
}
const SettingsTable<SharedSteps>& SharedSteps::table() {
  using S = SharedSteps;
  constexpr const char* kSource = "Holländer 2013, table 3.4";
  static const SettingsTable<S> kTable = {
      {&S::events, "events", "Who says what becomes of each entry", kSource},
      {&S::sums, "sums", "Who sums up where entries go", kSource},
      {&S::eventTasks,
       "event_tasks",
       {1, 16},
       "",
       "Parts in which the CPU reads, finds and writes back events",
       kSource},
      {&S::sumTasks, "sum_tasks", {1, 16}, "", "Parts in which the CPU reads and writes back sums", kSource}};
  return kTable;
}
const SettingsTable<HybridSettings>& HybridSettings::table() {
  using S = HybridSettings;
  static const SettingsTable<S> kTable = {
      {&S::share, "share", "What the CPU does", "Holländer 2013, section 3.7.3"}};
  return kTable;
}
const SettingsTable<GeometryShaderCuts>& GeometryShaderCuts::table() {
  using S = GeometryShaderCuts;
  static const SettingsTable<S> kTable = {
      {&S::start, "start", "The last frame's cut, or the root", "Holländer 2013, section 3.5.2"}};
  return kTable;
}

}  // namespace limen::many_lods

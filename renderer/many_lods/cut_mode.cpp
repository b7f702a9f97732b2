// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/cut_mode.h"

#include "renderer/many_lods/many_lods_bindings.h"

namespace limen::many_lods {
namespace {

template <class S>
const SettingsTable<S>& stepsTable() {
  static const SettingsTable<S> kTable = {{&S::stepLevels,
                                           "step_levels",
                                           {1, kMostSplitLevels},
                                           "",
                                           "Levels of the tree by which an entry is split at once: fewer steps, "
                                           "more work for one invocation"}};
  return kTable;
}

template <class S>
const SettingsTable<S>& edgesTable() {
  static const SettingsTable<S> kTable = {{&S::edges,
                                           "edges",
                                           {1, 24},
                                           "",
                                           "Edges of the tree by which an entry may move in a frame",
                                           "Holländer 2013, section 3.5.2 (q)"}};
  return kTable;
}

}  // namespace

const SettingsTable<BasicCuts>& BasicCuts::table() { return stepsTable<BasicCuts>(); }
const SettingsTable<IncrementalCuts>& IncrementalCuts::table() { return stepsTable<IncrementalCuts>(); }
const SettingsTable<LazyCuts>& LazyCuts::table() { return edgesTable<LazyCuts>(); }
const SettingsTable<LiteralCuts>& LiteralCuts::table() { return edgesTable<LiteralCuts>(); }

}  // namespace limen::many_lods

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/cut_mode.h"

#include <bit>
#include <cstdint>

#include "renderer/many_lods/many_lods_bindings.h"

namespace limen::many_lods {
namespace {

constexpr const char *kArityText = "Children of a node: of 4 and 8 every second and third level of the tree is one",
                      *kAritySource = "Holländer 2013, section 3.8";

template <class S>
const SettingsTable<S>& stepsTable() {
  static const SettingsTable<S> kTable = {{&S::arity, "arity", oneOf({2, 4, 8}), "", kArityText, kAritySource},
                                          {&S::stepLevels,
                                           "step_levels",
                                           {1, kMostSplitLevels},
                                           "",
                                           "Levels of the tree by which an entry is split at once: fewer steps, "
                                           "more work for one invocation"}};
  return kTable;
}

template <class S>
const SettingsTable<S>& edgesTable() {
  static const SettingsTable<S> kTable = {{&S::arity, "arity", oneOf({2, 4, 8}), "", kArityText, kAritySource},
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
  return std::visit([](const auto& form) { return std::bit_width(static_cast<uint32_t>(form.arity)) - 1; },
                    mode);
}

const SettingsTable<BasicCuts>& BasicCuts::table() { return stepsTable<BasicCuts>(); }
const SettingsTable<IncrementalCuts>& IncrementalCuts::table() { return stepsTable<IncrementalCuts>(); }
const SettingsTable<LazyCuts>& LazyCuts::table() { return edgesTable<LazyCuts>(); }
const SettingsTable<LiteralCuts>& LiteralCuts::table() { return edgesTable<LiteralCuts>(); }

}  // namespace limen::many_lods

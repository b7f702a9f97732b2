// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/settings_table.h"

namespace limen::many_lods {

/// From the root in every frame. Source: Holländer 2013, section 3.5.2.
struct BasicCuts {
  static constexpr const char *kKind = "basic", *kSummary = "from the root in every frame";
  int arity = 2;
  int stepLevels = 3;
  static const SettingsTable<BasicCuts>& table();
};
/// From the cut of the frame before, until every node is right.
struct IncrementalCuts {
  static constexpr const char *kKind = "incremental", *kSummary = "from the last frame's cut, to the end";
  int arity = 2;
  int stepLevels = 3;
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
using CutMode = std::variant<IncrementalCuts, LazyCuts, BasicCuts, LiteralCuts>;

/// Of the tree as the mode walks it: nodes have 2^arityBitsOf() children. Those of a complete binary tree's
/// levels between are passed over.
int arityBitsOf(const CutMode& mode);

}  // namespace limen::many_lods

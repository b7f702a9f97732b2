// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/ray_hierarchy/traversal_settings.h"

#include "experiments/base/error.h"
#include "renderer/techniques/reflections/ray_hierarchy/ray_hierarchy_bindings.h"

namespace limen::techniques {

const SettingsTable<HalvedBatches>& HalvedBatches::table() {
  static const SettingsTable<HalvedBatches> kTable = {{&HalvedBatches::mostBatches,
                                                       "most_batches",
                                                       {1, kHierarchyMostBatches},
                                                       "",
                                                       "Batches of triangles at most",
                                                       "Roger 2008, section 3.3.4"}};
  return kTable;
}
const SettingsTable<SpilledPairs>& SpilledPairs::table() {
  static const SettingsTable<SpilledPairs> kTable = {{&SpilledPairs::room,
                                                      "room",
                                                      {1, 1 << 25},
                                                      "pairs",
                                                      "Pairs that may wait for a later batch",
                                                      "Roger 2008, section 3.3.4"}};
  return kTable;
}
const SettingsTable<FixedBatches>& FixedBatches::table() {
  static const SettingsTable<FixedBatches> kTable = {{&FixedBatches::triangles,
                                                      "triangles",
                                                      {1, 1 << 25},
                                                      "",
                                                      "Triangles of a batch",
                                                      "Roger 2008, section 3.3.4"}};
  return kTable;
}

const SettingsTable<FusedReduction>& FusedReduction::table() {
  static const SettingsTable<FusedReduction> kTable = {};
  return kTable;
}
const SettingsTable<SeparateReduction>& SeparateReduction::table() {
  static const SettingsTable<SeparateReduction> kTable = {
      {&SeparateReduction::form, "form", "How the stream is reduced", "Roger 2008, chapter 4"}};
  return kTable;
}

void TraversalSettings::check() const {
  if (std::holds_alternative<SeparateReduction>(reduction) && std::holds_alternative<SpilledPairs>(overflow))
    throw Error("a separate reduction packs all pairs or none: none are left to wait", "overflow",
                "choose halved_batches or fixed_batches, or a fused reduction");
}

const SettingsTable<TraversalSettings>& TraversalSettings::table() {
  using S = TraversalSettings;
  static const SettingsTable<S> kTable = {
      {&S::merge, "merge", "How nodes enclose their children", "open in Roger 2008"},
      {&S::test, "test", "How a node is tested against a triangle's sphere",
       "Roger 2008, equation 3.1, corrected"},
      {&S::startNodes,
       "start_nodes",
       {1, 65536},
       "nodes",
       "Nodes at most on the level that all triangles are tested with first; 1 is the root",
       "1 in Roger 2008, section 3.3.3; more are the bench's own"},
      {&S::leafSide, "leaf_side", oneOf({1, 2, 4, 8}), "rays",
       "Side of the nodes whose rays are tested with a triangle itself",
       "1 in Roger 2008, section 3.3.3; more are the bench's own"},
      {&S::capacity,
       "capacity",
       {1, 1 << 25},
       "pairs",
       "Pairs of nodes and triangles that a stream has room for",
       "2048 x 2048 in Roger 2008, section 3.3.4"},
      {&S::reduction, "reduction", "How the pairs that remain are packed",
       "separate in Roger 2008, section 3.3.3; fused is the bench's own"},
      {&S::overflow, "overflow", "What happens when pairs find no room"}};
  return kTable;
}

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "experiments/viewer/result_panes.h"
#include "renderer/techniques/technique.h"

namespace limen::viewer {
namespace {

/// What the technique declares about one of its counters.
Quantity quantityOf(const std::string& technique, const std::string& counter) {
  if (const auto* info = techniques::TechniqueRegistry::instance().find(technique))
    for (const Quantity& quantity : info->counters)
      if (quantity.name == counter) return quantity;
  return counter;
}

/// The title if there is one; the name, as in descriptors and stores, in the tooltip.
void nameCell(const Quantity& quantity) {
  ImGui::TextUnformatted((quantity.title.empty() ? quantity.name : quantity.title).c_str());
  if (!ImGui::IsItemHovered()) return;
  std::string text = quantity.name;
  if (const std::string better = directionText(quantity.direction); !better.empty()) text += ", " + better;
  if (!quantity.source.empty()) text += "\n" + quantity.source;
  ImGui::SetTooltip("%s", text.c_str());
}

}  // namespace

void counterPane(const PaneContext& pane) {
  const Rendered* first = pane.state.rendered(0);
  if (!first || first->counters.empty() || !heading("Counters")) return;
  const Rendered* second = pane.state.rendered(1);
  if (!numberTable("counters", second ? 3 : 2)) return;
  for (const techniques::Counter& counter : first->counters) {
    const Quantity quantity = quantityOf(pane.state.shown->setup.technique.name, counter.name);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    nameCell(quantity);
    ImGui::TableNextColumn();
    numberCell(counter.value, quantity.unit);
    if (!second) continue;
    ImGui::TableNextColumn();
    for (const techniques::Counter& other : second->counters)
      if (other.name == counter.name) numberCell(other.value, "");
  }
  ImGui::EndTable();
}

}  // namespace limen::viewer

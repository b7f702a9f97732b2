// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/pane.h"

#include <cmath>

namespace limen::viewer {

bool heading(const char* text) { return ImGui::CollapsingHeader(text, ImGuiTreeNodeFlags_DefaultOpen); }

void errorText(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, {1.0F, 0.45F, 0.35F, 1.0F});
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

void dimText(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
  ImGui::TextWrapped("%s", text.c_str());
  ImGui::PopStyleColor();
}

bool numberTable(const char* id, int columns) {
  if (!ImGui::BeginTable(id, columns, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingFixedFit)) return false;
  ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch);
  return true;
}

void label(const std::string& text) {
  ImGui::TextUnformatted(text.c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
}

void numberCell(double value, const std::string& unit) {
  ImGui::TextUnformatted((numberText(value) + (unit.empty() || std::isnan(value) ? "" : " " + unit)).c_str());
  if (ImGui::IsItemHovered() && !std::isnan(value)) ImGui::SetTooltip("%.9g %s", value, unit.c_str());
}

std::string directionText(Direction direction) {
  switch (direction) {
    case Direction::LowerIsBetter:
      return "lower is better";
    case Direction::HigherIsBetter:
      return "higher is better";
    case Direction::Neither:
      return "";
  }
  return "";
}

}  // namespace limen::viewer

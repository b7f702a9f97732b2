// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/pane.h"

#include <cmath>
#include <cstdio>

namespace limen::viewer {

bool heading(const char* text) { return ImGui::CollapsingHeader(text, ImGuiTreeNodeFlags_DefaultOpen); }

void errorText(const std::string& text) {
  ImGui::PushStyleColor(ImGuiCol_Text, {1.0F, 0.45F, 0.35F, 1.0F});
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

std::string numberText(double value) {
  if (std::isnan(value)) return "";
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

std::string bytesText(int64_t bytes) {
  const double mb = 1e-6 * static_cast<double>(bytes);
  char text[32];
  std::snprintf(text, sizeof text, mb < 10.0 ? "%.2f MB" : "%.0f MB", mb);
  return text;
}

}  // namespace limen::viewer

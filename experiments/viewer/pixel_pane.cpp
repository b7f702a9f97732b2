// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/result_panes.h"

namespace limen::viewer {
namespace {

void row(const std::string& name, const std::vector<double>& values) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(name.c_str());
  ImGui::TableNextColumn();
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : "  ") + numberText(value);
  ImGui::TextWrapped("%s", text.c_str());
}

std::vector<double> channelsAt(const Image& image, glm::ivec2 at) {
  std::vector<double> values;
  if (at.x < image.width && at.y < image.height)
    for (int c = 0; c < image.channels; ++c) values.push_back(image.at(at.x, at.y, c));
  return values;
}

}  // namespace

void pixelPane(const PaneContext& pane) {
  if (!heading("Pixel")) return;
  const ViewerState& state = pane.state;
  if (!state.pickedPx) {
    ImGui::TextDisabled("click a pixel of the picture");
    return;
  }
  const glm::ivec2 at = *state.pickedPx;
  ImGui::Text("x %d, y %d", at.x, at.y);
  if (!state.shown ||
      !ImGui::BeginTable("pixel", 2, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp))
    return;
  for (size_t i = 0; i < state.shown->rendered.size(); ++i)
    for (const PickedValues& picked : state.shown->rendered[i].picked)
      row((i > 0 ? "second " : "") + picked.name, picked.values);
  if (state.evaluated) {
    if (state.evaluated->reference) row("reference", channelsAt(*state.evaluated->reference, at));
    for (const auto& [name, map] : state.evaluated->maps) row(name, channelsAt(*map.values, at));
  }
  ImGui::EndTable();
}

}  // namespace limen::viewer

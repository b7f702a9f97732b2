// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "experiments/viewer/result_panes.h"

namespace limen::viewer {
namespace {

/// A word for each row: which way is better.
void directionCell(Direction direction) {
  const std::string text = directionText(direction);
  ImGui::TextDisabled("%s", text.substr(0, text.find(' ')).c_str());
  if (!text.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
}

void errorTable(const EvaluationResult& evaluated) {
  const bool two = std::any_of(evaluated.figures.begin(), evaluated.figures.end(),
                               [](const ErrorFigure& figure) { return !std::isnan(figure.second); });
  if (!numberTable("errors", two ? 4 : 3)) return;
  ImGui::TableSetupColumn(two ? "first" : "value");
  if (two) ImGui::TableSetupColumn("second");
  ImGui::TableSetupColumn("better");
  ImGui::TableHeadersRow();
  for (const ErrorFigure& figure : evaluated.figures) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    label(figure.metric);
    ImGui::TableNextColumn();
    numberCell(figure.value, figure.unit);
    if (two) {
      ImGui::TableNextColumn();
      numberCell(figure.second, figure.unit);
    }
    ImGui::TableNextColumn();
    directionCell(figure.direction);
  }
  ImGui::EndTable();
}

void errorMapChooser(const PaneContext& pane, const EvaluationResult& evaluated) {
  if (evaluated.maps.empty()) return;
  std::vector<std::string> names;
  for (const auto& [name, map] : evaluated.maps) names.push_back(name);
  std::string shown = pane.state.errorMap;
  if (!evaluated.maps.count(shown)) {
    shown = names.front();
    pane.commands.push(command::ChooseErrorMap{shown});
  }
  ImGui::TextDisabled("error map");
  if (const auto name = nameChooser(
          "map", names, shown, [](const std::string&) { return std::string("where the errors are"); },
          pane.controls))
    pane.commands.push(command::ChooseErrorMap{*name});
}

void predictionControls(const PaneContext& pane) {
  int overlay = static_cast<int>(pane.state.overlay);
  ImGui::SetNextItemWidth(-1.0F);
  if (ImGui::Combo("##overlay", &overlay, "no prediction\0threshold map\0popping\0")) {
    const auto wanted = static_cast<Overlay>(overlay);
    pane.commands.push(command::Predict{wanted});
    pane.commands.push(command::Arrange{wanted == Overlay::None ? Arrangement::First : Arrangement::Overlay});
  }
  pane.controls.note("overlay");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "what a person would see, predicted for the display below:\nthreshold map: luminance increments that "
        "stay invisible\npopping: what is noticed when the first picture replaces the second (or the "
        "reference)");
  if (const auto name = nameChooser("display", perception::displayPresets(), pane.state.displayName,
                                    &perception::displayPresetReason, pane.controls))
    pane.commands.push(command::ChooseDisplay{*name});
}

}  // namespace

void errorPane(const PaneContext& pane) {
  if (!heading("Error")) return;
  const ViewerState& state = pane.state;
  if (!state.setup.reference) {
    ImGui::TextDisabled("no reference is chosen");
  } else if (!state.evaluated) {
    ImGui::TextDisabled("the reference is being rendered");
  } else if (state.evaluated->error.empty()) {
    const EvaluationResult& evaluated = *state.evaluated;
    ImGui::TextDisabled("against %s", state.setup.reference->name.c_str());
    if (!evaluated.step.empty()) ImGui::TextColored(kInProgressColour, "so far: %s", evaluated.step.c_str());
    if (evaluated.bound >= 0.0)
      ImGui::TextDisabled("reference noise: at most %s per pixel (99.9 %%)",
                          numberText(evaluated.bound).c_str());
    errorTable(evaluated);
    errorMapChooser(pane, evaluated);
  }
  predictionControls(pane);
  if (state.evaluated && !state.evaluated->overlayNote.empty())
    ImGui::TextWrapped("%s", state.evaluated->overlayNote.c_str());
}

}  // namespace limen::viewer

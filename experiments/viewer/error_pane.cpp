// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "experiments/viewer/result_panes.h"

namespace limen::viewer {
namespace {

/// The metric, with its better direction in the tooltip as well: narrow panes have no column for it.
void metricCell(const ErrorFigure& figure) {
  ImGui::TextUnformatted(figure.metric.c_str());
  if (!ImGui::IsItemHovered()) return;
  const std::string better = directionText(figure.direction);
  ImGui::SetTooltip("%s%s", figure.metric.c_str(), better.empty() ? "" : (": " + better).c_str());
}

void errorTable(const EvaluationResult& evaluated) {
  const bool two = std::any_of(evaluated.figures.begin(), evaluated.figures.end(),
                               [](const ErrorFigure& figure) { return !std::isnan(figure.second); });
  const bool wide = ImGui::GetContentRegionAvail().x > (two ? 20.0F : 12.0F) * ImGui::GetFontSize();
  if (!numberTable("errors", (two ? 3 : 2) + (wide ? 1 : 0))) return;
  ImGui::TableSetupColumn(two ? "first" : "value");
  if (two) ImGui::TableSetupColumn("second");
  if (wide) ImGui::TableSetupColumn("better");
  ImGui::TableHeadersRow();
  for (const ErrorFigure& figure : evaluated.figures) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    metricCell(figure);
    ImGui::TableNextColumn();
    numberCell(figure.value, figure.unit);
    if (two) {
      ImGui::TableNextColumn();
      numberCell(figure.second, figure.unit);
    }
    if (!wide) continue;
    ImGui::TableNextColumn();
    const std::string better = directionText(figure.direction);
    ImGui::TextDisabled("%s", better.substr(0, better.find(' ')).c_str());
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
  if (ImGui::Combo("##overlay", &overlay, "no prediction\0thresholds\0single threshold map\0popping\0")) {
    const auto wanted = static_cast<Overlay>(overlay);
    pane.commands.push(command::Predict{wanted});
    pane.commands.push(command::Arrange{wanted == Overlay::None ? Arrangement::First : Arrangement::Overlay});
  }
  pane.controls.note("overlay");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "what a person would see, predicted for the display below:\nthresholds: luminance differences that "
        "are not seen, whatever their frequencies\nsingle threshold map: as in Schwarz 2009, section 9.4, "
        "one "
        "threshold for all frequencies; differences below it may be visible\npopping: what is noticed when "
        "the "
        "first picture replaces the second (or the reference)");
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
    dimText("against " + state.setup.reference->name);
    if (!evaluated.step.empty()) ImGui::TextColored(kInProgressColour, "so far: %s", evaluated.step.c_str());
    if (evaluated.bound >= 0.0)
      dimText("reference noise: at most " + numberText(evaluated.bound) + " per pixel (99.9 %)");
    errorTable(evaluated);
    errorMapChooser(pane, evaluated);
  }
  predictionControls(pane);
  if (state.evaluated && !state.evaluated->overlayNote.empty())
    ImGui::TextWrapped("%s", state.evaluated->overlayNote.c_str());
}

}  // namespace limen::viewer

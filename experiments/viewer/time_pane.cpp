// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "experiments/viewer/result_panes.h"

namespace limen::viewer {
namespace {

/// The latest times of a pass as a small chart, `height` text lines high.
void timeChart(const ViewerState& state, const std::string& pass, float height) {
  const auto found = state.passMs.find(pass);
  if (found == state.passMs.end()) return;
  const std::vector<float> times(found->second.begin(), found->second.end());
  const float most = *std::max_element(times.begin(), times.end());
  const float em = ImGui::GetFontSize();
  ImGui::PlotLines(("##" + pass).c_str(), times.data(), static_cast<int>(times.size()), 0, nullptr, 0.0F,
                   most, {height > 2.0F ? -1.0F : 4.0F * em, height * em});
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%s: the last %zu pictures, 0 to %.3g ms", pass.c_str(), times.size(), most);
}

void passTable(const PaneContext& pane, const Rendered& rendered, bool wide) {
  if (!numberTable("passes", wide ? 4 : 2)) return;
  int64_t bytes = 0;
  for (const PassFigure& pass : rendered.passes) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    label(pass.name);
    ImGui::TableNextColumn();
    if (pass.ms >= 0.0) numberCell(pass.ms, "ms");
    bytes += pass.bytes;
    if (!wide) continue;
    ImGui::TableNextColumn();
    timeChart(pane.state, pass.name, 1.0F);
    ImGui::TableNextColumn();
    if (pass.bytes > 0) ImGui::TextUnformatted(bytesText(pass.bytes).c_str());
  }
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("memory, all passes");
  ImGui::TableSetColumnIndex(wide ? 3 : 1);
  ImGui::TextDisabled("%s", bytesText(bytes).c_str());
  ImGui::EndTable();
}

}  // namespace

void timePane(const PaneContext& pane, float widthPx) {
  if (!heading("Time and memory")) return;
  const ViewerState& state = pane.state;
  ImGui::TextWrapped("%s", state.device.line().c_str());
  bool continuous = state.continuous;
  if (ImGui::Checkbox("measure continuously", &continuous))
    pane.commands.push(command::MeasureContinuously{continuous});
  pane.controls.note("times.continuous");
  const Rendered* first = state.rendered(0);
  if (!first) return;
  if (first->frameMs >= 0.0) {
    ImGui::Text("%s ms %s", numberText(first->frameMs).c_str(), first->onCpu ? "wall" : "GPU");
    if (const Rendered* second = state.rendered(1); second && second->frameMs >= 0.0) {
      dimText("second " + numberText(second->frameMs) + " ms");
    }
    if (first->onCpu && state.device.software) dimText("rendered on a CPU: compare techniques only");
  }
  timeChart(state, "frame", 3.0F);
  passTable(pane, *first, widthPx > 22.0F * ImGui::GetFontSize());
  if (first->prepareMs >= 0.0) ImGui::TextDisabled("prepared in %s ms", numberText(first->prepareMs).c_str());
}

}  // namespace limen::viewer

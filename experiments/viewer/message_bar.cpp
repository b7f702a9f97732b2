// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/viewer/result_panes.h"

namespace limen::viewer {

namespace {

constexpr std::array<const char*, 7> kKeys = {
    "K export descriptor", "P save pictures",    "R reset camera", "F frame the scene",
    "Space play",          "1 to 7 arrangement", "Tab panes"};

float paddingPx() { return 0.5F * ImGui::GetFontSize(); }

/// What the bar says, wrapped between items where there are several.
std::string barText(const ViewerState& state, float widthPx) {
  const std::string working = state.saving ? "saving pictures" : state.atRest ? "" : "working";
  std::vector<std::string> items;
  if (state.messages.empty())
    items.assign(kKeys.begin(), kKeys.end());
  else
    items.push_back(state.messages.back());
  if (!working.empty()) items.insert(items.begin(), working);
  std::string out, line;
  for (const std::string& item : items) {
    const std::string longer = line.empty() ? item : line + "   " + item;
    const bool fits = ImGui::CalcTextSize(longer.c_str()).x <= widthPx;
    if (!fits && !line.empty()) {
      out += line + "\n";
      line = item;
    } else {
      line = longer;
    }
  }
  return out + line;
}

}  // namespace

float messageBarHeight(const ViewerState& state, float widthPx) {
  const float width = std::max(widthPx - 2.0F * paddingPx(), 1.0F), em = ImGui::GetFontSize();
  const float height = ImGui::CalcTextSize(barText(state, width).c_str(), nullptr, false, width).y;
  return std::round(std::max(2.0F * em, height + 0.8F * em));
}

void messageBar(const PaneContext& pane, glm::vec2 sizePx, float heightPx) {
  const std::vector<std::string>& messages = pane.state.messages;
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({0, sizePx.y - heightPx});
  ImGui::SetNextWindowSize({sizePx.x, heightPx});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {paddingPx(), 0.3F * em});
  ImGui::Begin("messages", nullptr, kFixedWindow | ImGuiWindowFlags_NoScrollbar);
  const bool busy = pane.state.saving || !pane.state.atRest;
  const ImVec4 dim = ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled);
  ImGui::PushStyleColor(ImGuiCol_Text, busy               ? kInProgressColour
                                       : messages.empty() ? dim
                                                          : ImGui::GetStyleColorVec4(ImGuiCol_Text));
  ImGui::PushTextWrapPos(0.0F);
  ImGui::TextUnformatted(barText(pane.state, std::max(sizePx.x - 2.0F * paddingPx(), 1.0F)).c_str());
  ImGui::PopTextWrapPos();
  ImGui::PopStyleColor();
  pane.controls.note("messages");
  if (ImGui::IsWindowHovered() && messages.size() > 1) {
    ImGui::BeginTooltip();
    for (const std::string& message : messages) ImGui::TextUnformatted(message.c_str());
    ImGui::EndTooltip();
  }
  ImGui::End();
  ImGui::PopStyleVar();
}

void shaderFailureWindow(const PaneContext& pane, glm::vec2 leastPx, float widthPx) {
  if (pane.state.shaderFailure.empty()) return;
  ImGui::SetNextWindowPos({leastPx.x, leastPx.y}, ImGuiCond_Always);
  ImGui::SetNextWindowSize({widthPx, 0.0F});
  ImGui::Begin("shader error", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_AlwaysAutoResize);
  errorText("A changed shader does not compile; the previous version stays in use.");
  ImGui::TextWrapped("%s", pane.state.shaderFailure.c_str());
  if (ImGui::Button("close")) pane.commands.push(command::DismissShaderFailure{});
  ImGui::End();
}

}  // namespace limen::viewer

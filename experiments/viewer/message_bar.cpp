// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/result_panes.h"

namespace limen::viewer {

void messageBar(const PaneContext& pane, glm::vec2 sizePx, float heightPx) {
  const std::vector<std::string>& messages = pane.state.messages;
  const float em = ImGui::GetFontSize();
  ImGui::SetNextWindowPos({0, sizePx.y - heightPx});
  ImGui::SetNextWindowSize({sizePx.x, heightPx});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.5F * em, 0.3F * em});
  ImGui::Begin("messages", nullptr, kFixedWindow | ImGuiWindowFlags_NoScrollbar);
  if (!pane.state.atRest) {
    ImGui::TextColored(kInProgressColour, "working");
    ImGui::SameLine();
  }
  if (messages.empty())
    ImGui::TextDisabled(
        "K export descriptor, P save pictures, R reset camera, F frame the scene, Space play, 1 to 7 "
        "arrangement, Tab panes");
  else
    ImGui::TextUnformatted(messages.back().c_str());
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

// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/interface.h"

#include <algorithm>
#include <cmath>

#include "experiments/viewer/result_panes.h"
#include "experiments/viewer/setup_panes.h"

namespace limen::viewer {

void handleKeys(const PaneContext& pane) {
  if (ImGui::GetIO().WantTextInput) return;
  const auto on = [&](int key, ViewerCommand command) {
    if (ImGui::IsKeyPressed(key, false)) pane.commands.push(std::move(command));
  };
  on('K', command::ExportDescriptor{});
  on('P', command::SavePictures{});
  on('R', command::ResetCamera{});
  on('F', command::FrameScene{});
  on(ImGui::GetKeyIndex(ImGuiKey_Space), command::TogglePlayback{});
  on(ImGui::GetKeyIndex(ImGuiKey_Tab), command::TogglePanes{});
  constexpr Arrangement kByNumber[] = {Arrangement::First,  Arrangement::Second,  Arrangement::SideBySide,
                                       Arrangement::Split,  Arrangement::Flicker, Arrangement::ErrorMap,
                                       Arrangement::Overlay};
  for (int i = 0; i < 7; ++i) on('1' + i, command::Arrange{kByNumber[i]});
}

void Interface::build(const PaneContext& pane, glm::vec2 sizePx, float emPx, double secondsPassed) {
  // The picture gets what is left, and at least half of the width.
  const bool hidden = pane.state.panesHidden;
  const float left =
      hidden ? 0.0F : std::min(std::max(0.25F * sizePx.x, 22.0F * emPx), 0.27F * sizePx.x + 4.0F * emPx);
  const float right =
      hidden ? 0.0F : std::min(std::max(0.24F * sizePx.x, 24.0F * emPx), 0.26F * sizePx.x + 4.0F * emPx);
  const float bottom = std::min(messageBarHeight(pane.state, sizePx.x), std::round(0.3F * sizePx.y));
  handleKeys(pane);
  if (!hidden) {
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize({left, sizePx.y - bottom});
    ImGui::Begin("setup", nullptr, kFixedWindow);
    scenePane(pane);
    techniquePane(pane);
    referencePane(pane);
    secondTechniquePane(pane);
    camera_.build(pane);
    exportPane(pane);
    ImGui::End();
    ImGui::SetNextWindowPos({sizePx.x - right, 0});
    ImGui::SetNextWindowSize({right, sizePx.y - bottom});
    ImGui::Begin("results", nullptr, kFixedWindow);
    timePane(pane, right);
    errorPane(pane);
    counterPane(pane);
    pixelPane(pane);
    ImGui::End();
  }
  messageBar(pane, sizePx, bottom);
  picture_.build(pane, {left, 0.0F}, {sizePx.x - right, sizePx.y - bottom}, secondsPassed);
  shaderFailureWindow(pane, {left + emPx, emPx},
                      std::max(sizePx.x - left - right - 2.0F * emPx, 20.0F * emPx));
}

}  // namespace limen::viewer

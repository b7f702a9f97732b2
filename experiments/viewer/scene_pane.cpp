// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/setup_panes.h"
#include "renderer/scene/scene.h"

namespace limen::viewer {
namespace {

std::string aboutScene(const std::string& name) {
  const scene::SceneInfo* info = scene::SceneRegistry::instance().find(name);
  return info ? info->summary + (info->source.empty() ? "" : "\n" + info->source) : "";
}

}  // namespace

void scenePane(const PaneContext& pane) {
  if (!heading("Scene")) return;
  const ViewerState& state = pane.state;
  const Entry& scene = state.setup.scene;
  if (const auto name = nameChooser("scene", scene::SceneRegistry::instance().names(), scene.name, aboutScene,
                                    pane.controls))
    pane.commands.push(command::ChooseEntry{Slot::Scene, *name});
  if (auto change = parameterControls("scene", sceneParameters(scene.name), scene, pane.controls))
    pane.commands.push(command::SetParameter{Slot::Scene, change->path, change->value});
  int side[2] = {state.setup.sizePx.x, state.setup.sizePx.y};
  ImGui::SetNextItemWidth(-8.0F * ImGui::GetFontSize());
  ImGui::InputInt2("picture, px", side);
  pane.controls.note("scene.picture");
  if (ImGui::IsItemDeactivatedAfterEdit())
    pane.commands.push(
        command::SetPictureSize{glm::clamp(glm::ivec2(side[0], side[1]), glm::ivec2(1), glm::ivec2(8192))});
  if (!state.shown) return;
  if (!state.shown->error.empty())
    errorText(state.shown->error);
  else
    ImGui::TextDisabled("%zu triangles", state.shown->triangles);
}

}  // namespace limen::viewer

// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/camera_pane.h"

namespace limen::viewer {
namespace {

void playback(const PaneContext& pane) {
  const ViewerState& state = pane.state;
  const double duration = state.durationS(), zero = 0.0;
  if (duration <= 0.0) return;
  if (ImGui::Button(state.playing ? "pause" : "play")) pane.commands.push(command::TogglePlayback{});
  pane.controls.note("camera.play");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1.0F);
  double time = state.timeS;
  if (ImGui::SliderScalar("##time", ImGuiDataType_Double, &time, &zero, &duration, "%.2f s",
                          ImGuiSliderFlags_AlwaysClamp))
    pane.commands.push(command::SetTime{time});
  pane.controls.note("camera.time");
}

}  // namespace

void CameraPane::build(const PaneContext& pane) {
  if (!heading("Camera")) return;
  ImGui::TextDisabled(
      "drag: orbit; right drag with W A S D Q E: fly;\nmiddle drag: pan; wheel: closer or further");
  if (ImGui::Button("reset (R)")) pane.commands.push(command::ResetCamera{});
  pane.controls.note("camera.reset");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("back to the scene's own camera");
  ImGui::SameLine();
  if (ImGui::Button("frame the scene (F)")) pane.commands.push(command::FrameScene{});
  pane.controls.note("camera.frame");
  views(pane);
  playback(pane);
}

void CameraPane::views(const PaneContext& pane) {
  if (ImGui::Button(pane.state.recording ? "stop recording" : "record a path"))
    pane.commands.push(command::ToggleRecording{});
  pane.controls.note("camera.record");
  ImGui::SetNextItemWidth(-6.0F * ImGui::GetFontSize());
  ImGui::InputTextWithHint("##view name", "name of this view", viewName_.data(), viewName_.size());
  pane.controls.note("camera.view_name");
  ImGui::SameLine();
  const bool named = viewName_[0] != '\0';
  if (ImGui::Button("save view") && named) pane.commands.push(command::SaveView{viewName_.data()});
  pane.controls.note("camera.save_view");
  for (size_t i = 0; i < pane.state.views.size(); ++i) {
    const SavedView& view = pane.state.views[i];
    ImGui::PushID(static_cast<int>(i));
    if (ImGui::SmallButton(view.name.c_str())) pane.commands.push(command::RecallView{view});
    pane.controls.note("camera.view." + view.name);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s\n%s", view.scene.c_str(), view.camera.c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("x")) pane.commands.push(command::RemoveView{view.name});
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("delete this view");
    ImGui::PopID();
  }
}

}  // namespace limen::viewer

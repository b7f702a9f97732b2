// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/setup_panes.h"

namespace limen::viewer {

void exportPane(const PaneContext& pane) {
  if (!heading("Export")) return;
  if (ImGui::Button("descriptor (K)")) pane.commands.push(command::ExportDescriptor{});
  pane.controls.note("export.descriptor");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("what is on screen as a descriptor for limen sweep, into %s",
                      pane.state.resultsFolder.c_str());
  ImGui::SameLine();
  if (ImGui::Button("pictures (P)")) pane.commands.push(command::SavePictures{});
  pane.controls.note("export.pictures");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("PNG and EXR files of all products");
}

}  // namespace limen::viewer

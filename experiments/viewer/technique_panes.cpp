// SPDX-License-Identifier: BSD-3-Clause
// The technique, the second one and the reference.
#include "experiments/viewer/setup_panes.h"
#include "renderer/techniques/technique.h"

namespace limen::viewer {
namespace {

using techniques::TechniqueRegistry;

std::string aboutTechnique(const std::string& name, const std::set<std::string>& traits) {
  const techniques::TechniqueInfo* info = TechniqueRegistry::instance().find(name);
  if (!info) return {};
  std::string out = info->summary + (info->source.empty() ? "" : "\n" + info->source);
  for (const std::string& need : info->needs)
    if (!traits.empty() && !traits.count(need))
      out += "\nneeds a scene with " + need + ", which this one does not have";
  return out;
}

void techniqueChooser(const PaneContext& pane, Slot slot, const std::vector<std::string>& names,
                      const std::string& chosen) {
  const std::set<std::string> traits = pane.state.shown ? pane.state.shown->traits : std::set<std::string>{};
  if (const auto name = nameChooser(
          toText(slot), names, chosen, [&](const std::string& of) { return aboutTechnique(of, traits); },
          pane.controls))
    pane.commands.push(command::ChooseEntry{slot, *name});
}

void techniqueControls(const PaneContext& pane, Slot slot, const Entry& entry) {
  if (auto change = parameterControls(toText(slot), techniqueParameters(entry), entry, pane.controls))
    pane.commands.push(command::SetParameter{slot, change->path, change->value});
}

/// Names that may be chosen in addition to the technique, including none ("").
std::vector<std::string> comparableOrNone(const PaneContext& pane) {
  std::vector<std::string> names = comparable(pane.state.setup.technique.name);
  names.insert(names.begin(), "");
  return names;
}

void remarks(const Rendered& rendered) {
  if (!rendered.error.empty()) errorText(rendered.error);
  if (!rendered.failure.empty()) errorText(rendered.failure);
  for (const std::string& remark : rendered.remarks) ImGui::TextWrapped("- %s", remark.c_str());
}

void debugViews(const PaneContext& pane, const Rendered& rendered) {
  if (rendered.views.empty()) return;
  std::vector<std::string> views = rendered.views;
  views.insert(views.begin(), "");
  ImGui::TextDisabled("show instead of the product");
  if (const auto view = nameChooser(
          "view", views, pane.state.debugView,
          [](const std::string&) { return std::string("an intermediate image of the technique"); },
          pane.controls))
    pane.commands.push(command::ShowDebugView{*view});
  if (rendered.viewWhite > 0.0) ImGui::TextDisabled("brightest: %s", numberText(rendered.viewWhite).c_str());
}

}  // namespace

void techniquePane(const PaneContext& pane) {
  const bool open = heading("Technique");
  pane.controls.note("technique.heading");
  if (!open) return;
  ImGui::PushID("technique");
  const Entry& technique = pane.state.setup.technique;
  techniqueChooser(pane, Slot::Technique, TechniqueRegistry::instance().names(), technique.name);
  techniqueControls(pane, Slot::Technique, technique);
  if (const Rendered* rendered = pane.state.rendered(0)) {
    remarks(*rendered);
    debugViews(pane, *rendered);
  }
  ImGui::PopID();
}

void referencePane(const PaneContext& pane) {
  if (!heading("Reference")) return;
  ImGui::PushID("reference");
  const std::optional<Entry>& reference = pane.state.setup.reference;
  techniqueChooser(pane, Slot::Reference, comparableOrNone(pane), reference ? reference->name : "");
  if (reference) techniqueControls(pane, Slot::Reference, *reference);
  if (pane.state.evaluated && !pane.state.evaluated->error.empty()) errorText(pane.state.evaluated->error);
  ImGui::PopID();
}

void secondTechniquePane(const PaneContext& pane) {
  const bool open = ImGui::CollapsingHeader("Second technique");
  pane.controls.note("second.heading");
  if (!open) return;
  ImGui::PushID("second");
  const std::optional<Entry>& second = pane.state.setup.second;
  techniqueChooser(pane, Slot::Second, comparableOrNone(pane), second ? second->name : "");
  if (ImGui::Button("same as the first")) pane.commands.push(command::CopyToSecond{});
  pane.controls.note("second.copy");
  ImGui::SameLine();
  if (ImGui::Button("swap")) pane.commands.push(command::SwapTechniques{});
  pane.controls.note("second.swap");
  if (second) techniqueControls(pane, Slot::Second, *second);
  if (const Rendered* rendered = pane.state.rendered(1); rendered && second) remarks(*rendered);
  ImGui::PopID();
}

}  // namespace limen::viewer

// SPDX-License-Identifier: BSD-3-Clause
// All commands except those of the camera.
#include "experiments/viewer/viewer.h"

namespace limen::viewer {
namespace {

std::vector<Parameter> parametersOf(Slot slot, const Entry& entry) {
  return slot == Slot::Scene ? sceneParameters(entry.name) : techniqueParameters(entry);
}

/// Null if nothing is chosen there.
Entry* entryIn(ViewSetup& setup, Slot slot) {
  switch (slot) {
    case Slot::Scene:
      return &setup.scene;
    case Slot::Technique:
      return &setup.technique;
    case Slot::Second:
      return setup.second ? &*setup.second : nullptr;
    case Slot::Reference:
      return setup.reference ? &*setup.reference : nullptr;
  }
  return nullptr;
}

}  // namespace

void Viewer::execute(const ViewerCommand& command) {
  try {
    std::visit([this](const auto& one) { run(one); }, command);
  } catch (const std::exception& error) {
    say(error.what());
  }
}

void Viewer::run(const command::ChooseEntry& command) {
  ViewSetup& setup = state_.setup;
  const std::optional<Entry> chosen =
      command.name.empty() ? std::nullopt : std::optional(Entry{command.name, {}});
  switch (command.slot) {
    case Slot::Scene:
      if (!chosen) return;
      setup.scene = *chosen;
      state_.timeS = 0.0;
      break;
    case Slot::Technique: {
      if (!chosen) return;
      const bool otherKind = comparable(command.name) != comparable(setup.technique.name);
      setup.technique = *chosen;
      state_.debugView.clear();
      if (otherKind) setup.reference = usualReference(command.name), setup.second.reset();
      break;
    }
    case Slot::Second:
      setup.second = chosen;
      if (chosen && state_.arrangement == Arrangement::First) state_.arrangement = Arrangement::Split;
      break;
    case Slot::Reference:
      setup.reference = chosen;
      break;
  }
}

void Viewer::run(const command::SetParameter& command) {
  Entry* entry = entryIn(state_.setup, command.slot);
  if (!entry) return;
  const std::vector<Parameter> declared = parametersOf(command.slot, *entry);
  const Parameter* parameter = findDeclaration(declared, *entry, command.path);
  if (!parameter) return;
  memory_.set(*entry, declared, command.path, command.value ? *command.value : parameter->defaultValue);
  dropAbsent(*entry, parametersOf(command.slot, *entry));
}

void Viewer::run(const command::CopyToSecond&) { state_.setup.second = state_.setup.technique; }

void Viewer::run(const command::SwapTechniques&) {
  if (state_.setup.second) std::swap(state_.setup.technique, *state_.setup.second);
}

void Viewer::run(const command::SetPictureSize& command) { state_.setup.sizePx = command.sizePx; }
void Viewer::run(const command::ShowDebugView& command) { state_.debugView = command.name; }
void Viewer::run(const command::ChooseErrorMap& command) { state_.errorMap = command.name; }
void Viewer::run(const command::MeasureContinuously& command) { state_.continuous = command.on; }
void Viewer::run(const command::PickPixel& command) { state_.pickedPx = command.px; }
void Viewer::run(const command::ExportDescriptor&) { exportDescriptor(); }
void Viewer::run(const command::SavePictures&) { savePictures(); }
void Viewer::run(const command::DismissShaderFailure&) { state_.shaderFailure.clear(); }
void Viewer::run(const command::TogglePanes&) { state_.panesHidden = !state_.panesHidden; }

void Viewer::run(const command::Arrange& command) {
  state_.arrangement = command.arrangement;
  if (command.arrangement != Arrangement::Overlay || state_.overlay != Overlay::None) return;
  // Nothing was chosen: popping if there is another picture, thresholds need one only.
  const bool two = state_.setup.second || state_.setup.reference;
  run(command::Predict{two ? Overlay::Popping : Overlay::Thresholds});
}

void Viewer::run(const command::Predict& command) {
  state_.overlay = command.overlay;
  requestEvaluation();
}

void Viewer::run(const command::ChooseDisplay& command) {
  state_.display = perception::displayPreset(command.name);
  state_.displayName = command.name;
  requestEvaluation();
}

}  // namespace limen::viewer

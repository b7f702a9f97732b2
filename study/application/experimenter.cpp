// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/experimenter.h"

#include <imgui.h>

#include <algorithm>
#include <utility>

#include "renderer/window/ui_window.h"

namespace limen::study {
namespace {

constexpr int64_t kRedrawNs = 100'000'000;
constexpr glm::ivec2 kSizePx{720, 640};

}  // namespace

struct ExperimenterWindow::State {
  State(const window::UiWindowOptions& options, NoteCodes noteCodes)
      : window(options), codes(std::move(noteCodes)) {}
  window::UiWindow window;
  NoteCodes codes;
  std::vector<std::string> notes;
  int noted = 0;
  int64_t drawnNs = 0;
  bool confirming = false, abort = false;

  void build(const SessionWatch& watch);
};

ExperimenterWindow::ExperimenterWindow(int monitor, float scale, NoteCodes codes) {
  window::UiWindowOptions options;
  options.title = "Limen: experimenter";
  options.sizePx = glm::ivec2(glm::vec2(kSizePx) * std::max(scale, 1.0F));
  options.monitor = monitor;
  options.scale = scale;
  options.resizable = true;
  options.takesFocus = false;
  state_ = std::make_unique<State>(options, std::move(codes));
}

ExperimenterWindow::~ExperimenterWindow() = default;

std::vector<std::string> ExperimenterWindow::takeNotes() { return std::exchange(state_->notes, {}); }
std::vector<window::Input> ExperimenterWindow::takeKeys() {
  std::vector<window::Input> inputs = state_->window.takeInputs();
  inputs.erase(
      std::remove_if(inputs.begin(), inputs.end(),
                     [](const window::Input& input) { return input.device != window::Device::Keyboard; }),
      inputs.end());
  return inputs;
}
bool ExperimenterWindow::takeAbort() { return std::exchange(state_->abort, false); }

void ExperimenterWindow::State::build(const SessionWatch& watch) {
  const ImGuiIO& io = ImGui::GetIO();
  ImGui::SetNextWindowPos({0, 0});
  ImGui::SetNextWindowSize(io.DisplaySize);
  ImGui::PushFont(window.fonts().body);
  ImGui::Begin("experimenter", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings);
  ImGui::TextWrapped("Now: %s", watch.screen().c_str());
  ImGui::Separator();
  for (const std::string& line : watch.lines()) ImGui::TextWrapped("%s", line.c_str());
  ImGui::Separator();
  ImGui::TextWrapped("Note for the log (%d so far)", noted);
  const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  for (size_t i = 0; i < codes.size(); ++i) {
    if (i % 2 == 1) ImGui::SameLine();
    if (ImGui::Button(codes[i].first.c_str(), {half, 0})) {
      notes.push_back(codes[i].first);
      ++noted;
    }
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", codes[i].second.c_str());
  }
  ImGui::Separator();
  if (!confirming) {
    if (ImGui::Button("End the session ...")) confirming = true;
  } else {
    ImGui::TextWrapped("End it for good? Answers so far are kept, but the session cannot be resumed.");
    if (ImGui::Button("No")) confirming = false;
    ImGui::SameLine();
    if (ImGui::Button("Yes, end the session")) {
      abort = true;
      confirming = false;
    }
  }
  ImGui::End();
  ImGui::PopFont();
}

void ExperimenterWindow::tick(const SessionWatch& watch) {
  const int64_t now = window::steadyNs();
  if (now - state_->drawnNs < kRedrawNs) return;
  state_->drawnNs = now;
  if (state_->window.takeCloseRequest()) state_->confirming = true;
  state_->window.draw({0.12F, 0.12F, 0.13F}, [&] { state_->build(watch); });
  state_->window.show(0);
}

}  // namespace limen::study

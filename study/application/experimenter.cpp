// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/experimenter.h"

#include <imgui.h>

#include <utility>

#include "base/text.h"
#include "study/application/ui_window.h"

namespace limen::study {
namespace {

constexpr int64_t kRedrawNs = 100'000'000;
constexpr glm::ivec2 kSizePx{720, 640};

}  // namespace

const std::vector<std::string>& noteCodes() {
  static const std::vector<std::string> kCodes = {
      "noise in the room",          "light in the room changed",
      "participant was distracted", "participant moved from the seat",
      "instructions were repeated", "equipment trouble"};
  return kCodes;
}

void NoteBox::add(const std::string& code, const std::string& where) {
  notes_.push_back(where.empty() ? code : code + " (" + where + ")");
}

std::string NoteBox::take() { return join(std::exchange(notes_, {}), "; "); }

struct ExperimenterWindow::State {
  State(const UiWindowOptions& options) : window(options) {}
  UiWindow window;
  int64_t drawnNs = 0;
  bool confirming = false, abort = false;

  void build(const SessionWatch& watch, NoteBox& notes);
};

ExperimenterWindow::ExperimenterWindow(int monitor, float scale) {
  UiWindowOptions options;
  options.title = "Limen: experimenter";
  options.sizePx = kSizePx;
  options.monitor = monitor;
  options.scale = scale > 0 ? 0.7F * scale : 0.0F;
  options.resizable = true;
  state_ = std::make_unique<State>(options);
}

ExperimenterWindow::~ExperimenterWindow() = default;

bool ExperimenterWindow::takeAbort() { return std::exchange(state_->abort, false); }

void ExperimenterWindow::State::build(const SessionWatch& watch, NoteBox& notes) {
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
  ImGui::TextWrapped("Note (goes into the log with the next screen; %d waiting)", notes.waiting());
  const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  for (size_t i = 0; i < noteCodes().size(); ++i) {
    if (i % 2 == 1) ImGui::SameLine();
    if (ImGui::Button(noteCodes()[i].c_str(), {half, 0})) notes.add(noteCodes()[i], watch.screen());
  }
  ImGui::Separator();
  if (!confirming) {
    if (ImGui::Button("End the session ...")) confirming = true;
  } else {
    ImGui::TextWrapped("End it for good? What was answered is kept; it cannot be taken up again.");
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

void ExperimenterWindow::tick(const SessionWatch& watch, NoteBox& notes) {
  const int64_t now = steadyNs();
  if (now - state_->drawnNs < kRedrawNs) return;
  state_->drawnNs = now;
  state_->window.takeInputs();
  if (state_->window.takeCloseRequest()) state_->confirming = true;
  state_->window.draw({0.12F, 0.12F, 0.13F}, [&] { state_->build(watch, notes); });
  state_->window.show(0);
}

}  // namespace limen::study

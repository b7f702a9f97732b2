// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/viewer.h"

#include <imgui.h>

#include <algorithm>

#include "experiments/base/error.h"
#include "experiments/product.h"
#include "experiments/viewer/export_descriptor.h"
#include "experiments/viewer/interface.h"
#include "experiments/viewer/picture_files.h"
#include "perception/metrics/error_map.h"

namespace limen::viewer {
namespace {

constexpr size_t kTimesShown = 240, kMessagesShown = 50;

}  // namespace

Viewer::Viewer(window::UiSurface& surface, ViewerOptions options, std::function<void()> wake)
    : surface_(surface),
      render_(wake, options.shaderRoot),
      evaluation_(wake),
      writer_(wake),
      interface_(std::make_unique<Interface>()) {
  state_.device = render_.device();
  state_.resultsFolder = std::move(options.resultsFolder);
  state_.shaderRoot = std::move(options.shaderRoot);
  state_.display = std::move(options.display);
  state_.displayName = state_.display.name;
  readViews();
  show(std::move(options.setup));
}

Viewer::~Viewer() = default;

void Viewer::show(ViewSetup setup) {
  completeScene(setup.scene);
  completeTechnique(setup.technique);
  state_.setup = std::move(setup);
  requestPicture();
}

void Viewer::say(const std::string& message) {
  state_.messages.push_back(message);
  if (state_.messages.size() > kMessagesShown) state_.messages.erase(state_.messages.begin());
}

void Viewer::requestPicture() {
  request_ = {++number_,        state_.setup, state_.debugView, state_.pickedPx, moving_ || state_.playing,
              state_.continuous};
  render_.ask(request_);
}

void Viewer::requestEvaluation() {
  const Rendered* first = state_.rendered(0);
  if (!first || !state_.shown->settled || !first->product || !state_.shown->view) return;
  EvaluationRequest request;
  request.number = evaluatedNumber_ = state_.shown->number;
  request.setup = state_.shown->setup;
  request.kind = first->kind;
  request.product = first->product;
  if (const Rendered* second = state_.rendered(1); second && second->kind == first->kind)
    request.second = second->product;
  request.view = state_.shown->view;
  request.overlay = state_.overlay;
  request.display = state_.display;
  evaluationPending_ = request.setup.reference.has_value() || state_.overlay != Overlay::None;
  if (!evaluationPending_) {
    state_.evaluated.reset();
    return;
  }
  evaluation_.ask(std::move(request));
}

void Viewer::recordTimes() {
  const Rendered* first = state_.rendered(0);
  if (!first || first->frameMs < 0.0) return;
  const auto add = [&](const std::string& pass, double ms) {
    std::deque<float>& history = state_.passMs[pass];
    history.push_back(static_cast<float>(ms));
    if (history.size() > kTimesShown) history.pop_front();
  };
  add("frame", first->frameMs);
  for (const PassFigure& pass : first->passes)
    if (pass.ms >= 0.0) add(pass.name, pass.ms);
}

bool Viewer::takeResults() {
  bool changed = false;
  if (std::optional<RenderResult> result = render_.take()) {
    const bool another = !state_.shown || !state_.shown->settled || result->number != state_.shown->number;
    state_.shown = std::move(result);
    changed = true;
    recordTimes();
    if (state_.shown->settled && state_.shown->number == number_ && another) requestEvaluation();
    if (!state_.shown->settled) state_.evaluated.reset();
  }
  if (std::optional<ShaderNews> news = render_.takeNews()) {
    changed = true;
    state_.shaderFailure.clear();
    for (const std::string& failure : news->failures) state_.shaderFailure += failure + "\n";
    if (!news->rebuilt.empty())
      say(std::to_string(news->rebuilt.size()) + " shader programs rebuilt after a change");
  }
  if (std::optional<EvaluationResult> result = evaluation_.take();
      result && result->number == evaluatedNumber_) {
    state_.evaluated = std::move(result);
    if (state_.evaluated->step.empty()) evaluationPending_ = false;
    changed = true;
  }
  const bool saving = writer_.busy();
  for (const PictureWriter::Report& report : writer_.take()) {
    say(report.error.empty() ? "pictures saved in " + report.path : report.error);
    changed = true;
  }
  changed = changed || saving != state_.saving;
  state_.saving = saving;
  return changed;
}

bool Viewer::animated() const {
  return state_.playing || flying_ || state_.recording || state_.continuous ||
         state_.arrangement == Arrangement::Flicker;
}

bool Viewer::atRest() const {
  const std::optional<RenderResult>& shown = state_.shown;
  if (!shown || !shown->settled || shown->number != number_ || !(state_.setup == request_.setup))
    return false;
  if (!shown->error.empty()) return true;
  const bool timed = std::all_of(shown->rendered.begin(), shown->rendered.end(), [](const Rendered& one) {
    return !one.error.empty() || one.frameMs >= 0.0;
  });
  return timed && !evaluationPending_;
}

std::string Viewer::exportDescriptor() {
  try {
    const std::string path = viewer::exportDescriptor(state_.setup, state_.resultsFolder);
    say("exported as " + path);
    return path;
  } catch (const std::exception& error) {
    say(error.what());
    return {};
  }
}

void Viewer::savePictures() {
  const std::optional<RenderResult>& shown = state_.shown;
  if (!shown || !shown->settled || !shown->view)
    return say("the picture is still being rendered; try again when it is done");
  // Everything that the thread needs is shared and no longer changes.
  writer_.write([render = *shown, evaluated = state_.evaluated, folder = state_.resultsFolder] {
    std::map<std::string, ProductImages> images;
    const auto add = [&](const std::string& name, const std::shared_ptr<const Image>& product,
                         techniques::ProductKind kind) {
      if (!product) return;
      images[name] = {product, std::make_shared<Image>(
                                   experiments::productPicture(kind, *product, render.view->shading))};
    };
    for (size_t i = 0; i < render.rendered.size(); ++i)
      add(i == 0 ? "product" : "second_product", render.rendered[i].product, render.rendered[i].kind);
    if (evaluated) {
      add("reference", evaluated->reference, render.rendered[0].kind);
      for (const auto& [name, map] : evaluated->maps)
        images[name] = {map.values,
                        std::make_shared<Image>(perception::errorPicture(*map.values, map.white))};
    }
    return writePictures(images, render.setup, folder);
  });
  state_.saving = true;
}

bool Viewer::close(std::chrono::milliseconds patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  render_.close();
  evaluation_.close();
  writer_.finish();
  const bool rendered = render_.waitUntil(end);
  return evaluation_.waitUntil(end) && rendered;
}

void Viewer::updateMoving() {
  const bool mouseHeld = ImGui::IsMouseDown(ImGuiMouseButton_Left) ||
                         ImGui::IsMouseDown(ImGuiMouseButton_Right) ||
                         ImGui::IsMouseDown(ImGuiMouseButton_Middle);
  // While a control is held, its value is not final.
  if (ImGui::IsAnyItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left) &&
      !ImGui::GetIO().WantTextInput && !(state_.setup == request_.setup))
    moving_ = true;
  else if (!mouseHeld && !flying_)
    moving_ = false;
}

void Viewer::build(double secondsPassed) {
  controls_.clear();
  play(secondsPassed);
  record(secondsPassed);
  state_.camera = currentCamera();
  state_.atRest = atRest();
  flying_ = false;
  const bool wasMoving = moving_;
  interface_->build({state_, commands_, controls_}, glm::vec2(surface_.sizePx()), surface_.fonts().bodyPx,
                    secondsPassed);
  for (const ViewerCommand& command : commands_.take()) execute(command);
  updateMoving();
  if (!(state_.setup == request_.setup) || state_.debugView != request_.view ||
      state_.pickedPx != request_.pickedPx || state_.continuous != request_.continuous ||
      (moving_ || state_.playing) != request_.moving || wasMoving != moving_)
    requestPicture();
}

}  // namespace limen::viewer

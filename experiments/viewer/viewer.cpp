// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/viewer.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "experiments/product.h"
#include "experiments/viewer/keep.h"
#include "experiments/viewer/panes.h"
#include "experiments/viewer/picture_pane.h"
#include "perception/metrics/error_map.h"
#include "renderer/scene/camera_text.h"
#include "renderer/scene/placement.h"

namespace limen::viewer {
namespace {

constexpr size_t kTimesShown = 240, kMessagesKept = 50;

}  // namespace

Viewer::Viewer(window::UiSurface& surface, ViewerOptions options, std::function<void()> wake)
    : surface_(surface),
      options_(std::move(options)),
      render_(wake, options_.shaderRoot),
      judge_(wake),
      device_(render_.device()),
      displayName_(options_.display.name) {
  readViews();
  choose(options_.choices);
}

Viewer::~Viewer() = default;

void Viewer::choose(Choices choices) {
  completeScene(choices.scene);
  completeTechnique(choices.technique);
  choices_ = std::move(choices);
  ask();
}

void Viewer::say(const std::string& message) {
  messages_.push_back(message);
  if (messages_.size() > kMessagesKept) messages_.erase(messages_.begin());
}

void Viewer::ask() {
  asked_ = choices_;
  request_ = {++number_, choices_, view_, pickedPx_, moving_ || playing_, continuous_};
  render_.ask(request_);
}

void Viewer::askJudge() {
  if (!shown_ || !shown_->settled || shown_->rendered.empty()) return;
  const Rendered& first = shown_->rendered[0];
  if (!first.product || !shown_->view) return;
  JudgeRequest request;
  request.number = judgedNumber_ = shown_->number;
  request.choices = shown_->choices;
  request.kind = first.kind;
  request.product = first.product;
  if (shown_->rendered.size() > 1 && shown_->rendered[1].kind == first.kind)
    request.other = shown_->rendered[1].product;
  request.view = shown_->view;
  request.overlay = overlay_;
  request.display = options_.display;
  judgePending_ = request.choices.reference.has_value() || overlay_ != Overlay::None;
  if (!judgePending_) {
    judged_.reset();
    return;
  }
  judge_.ask(std::move(request));
}

void Viewer::recordTimes() {
  if (shown_->rendered.empty() || shown_->rendered[0].frameMs < 0.0) return;
  const Rendered& first = shown_->rendered[0];
  const auto add = [&](const std::string& pass, double ms) {
    std::deque<float>& history = passMs_[pass];
    history.push_back(static_cast<float>(ms));
    if (history.size() > kTimesShown) history.pop_front();
  };
  add("frame", first.frameMs);
  for (const PassFigure& pass : first.passes)
    if (pass.ms >= 0.0) add(pass.name, pass.ms);
}

void Viewer::predict(Overlay overlay) {
  overlay_ = overlay;
  askJudge();
}

bool Viewer::takeResults() {
  bool changed = false;
  if (std::optional<RenderResult> result = render_.take()) {
    const bool another = !shown_ || !shown_->settled || result->number != shown_->number;
    shown_ = std::move(result);
    changed = true;
    recordTimes();
    if (shown_->settled && shown_->number == number_ && another) askJudge();
    if (!shown_->settled) judged_.reset();
  }
  if (std::optional<ShaderNews> news = render_.takeNews()) {
    changed = true;
    shaderFailure_.clear();
    for (const std::string& failure : news->failures) shaderFailure_ += failure + "\n";
    if (!news->rebuilt.empty())
      say("built anew: " + std::to_string(news->rebuilt.size()) + " programs of changed shaders");
  }
  if (std::optional<JudgeResult> result = judge_.take(); result && result->number == judgedNumber_) {
    judged_ = std::move(result);
    if (judged_->step.empty()) judgePending_ = false;
    changed = true;
  }
  return changed;
}

bool Viewer::animated() const {
  return playing_ || flying_ || recorder_.has_value() || continuous_ || arrangement == Arrangement::Flicker;
}

bool Viewer::atRest() const {
  if (!shown_ || !shown_->settled || shown_->number != number_ || !(choices_ == asked_)) return false;
  if (!shown_->error.empty()) return true;
  const bool timed = std::all_of(shown_->rendered.begin(), shown_->rendered.end(), [](const Rendered& one) {
    return !one.error.empty() || one.frameMs >= 0.0;
  });
  return timed && !judgePending_;
}

void Viewer::setCamera(const scene::Camera& camera) {
  scene::setCamera(choices_.scene.given, scene::StillView{scene::toText(camera)});
}

void Viewer::moveTo(const scene::Camera& camera) {
  setCamera(camera);
  playing_ = false;
  moving_ = true;
}

scene::Camera Viewer::cameraNow() const {
  const auto given = choices_.scene.given.find("camera.text");
  if (given != choices_.scene.given.end()) return scene::parseCamera(std::get<std::string>(given->second));
  return shown_ ? shown_->path.at(timeS_) : scene::Camera{};
}

void Viewer::dropCamera() {
  scene::clearCamera(choices_.scene.given);
  timeS_ = 0.0;
}

void Viewer::setTime(double timeS) {
  timeS_ = timeS;
  if (choices_.scene.given.count("camera.text")) scene::clearCamera(choices_.scene.given);
  if (timeS == 0.0)
    choices_.scene.given.erase("camera.time_s");
  else
    choices_.scene.given["camera.time_s"] = timeS;
}

std::shared_ptr<const ScreenPicture> Viewer::secondPicture() const {
  if (shown_ && shown_->rendered.size() > 1) return shown_->rendered[1].picture;
  return judged_ ? judged_->referencePicture : nullptr;
}

std::string Viewer::keepDescriptor() {
  try {
    const std::string path = keep(choices_, options_.resultsFolder);
    say("kept as " + path);
    return path;
  } catch (const std::exception& error) {
    say(error.what());
    return {};
  }
}

std::string Viewer::savePictures() {
  try {
    if (!shown_ || !shown_->settled || !shown_->view)
      throw Error("the picture is not at rest yet", {}, "try again");
    std::map<std::string, ProductImages> images;
    const auto add = [&](const std::string& name, const std::shared_ptr<const Image>& product,
                         techniques::ProductKind kind) {
      if (!product) return;
      images[name] = {product, std::make_shared<Image>(
                                   experiments::productPicture(kind, *product, shown_->view->shading))};
    };
    for (size_t i = 0; i < shown_->rendered.size(); ++i)
      add(i == 0 ? "product" : "second_product", shown_->rendered[i].product, shown_->rendered[i].kind);
    if (judged_ && judged_->reference) add("reference", judged_->reference, shown_->rendered[0].kind);
    if (judged_)
      for (const auto& [name, map] : judged_->maps)
        images[name] = {map.values,
                        std::make_shared<Image>(perception::errorPicture(*map.values, map.white))};
    const std::string path = writeProducts(images, shown_->choices, options_.resultsFolder);
    say("pictures in " + path);
    return path;
  } catch (const std::exception& error) {
    say(error.what());
    return {};
  }
}

void Viewer::handleKeys() {
  if (ImGui::GetIO().WantTextInput) return;
  const auto pressed = [](int key) { return ImGui::IsKeyPressed(key, false); };
  if (pressed('K')) keepDescriptor();
  if (pressed('P')) savePictures();
  if (pressed('R')) dropCamera();
  if (pressed('F') && shown_) setCamera(frameAll(shown_->camera, shown_->bounds, aspect()));
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Space), false))
    playing_ = !playing_ && durationS() > 0.0;
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Tab), false)) panesHidden_ = !panesHidden_;
  constexpr Arrangement kByNumber[] = {Arrangement::First,  Arrangement::Second,  Arrangement::SideBySide,
                                       Arrangement::Split,  Arrangement::Flicker, Arrangement::ErrorMap,
                                       Arrangement::Overlay};
  for (int i = 0; i < 7; ++i)
    if (pressed('1' + i)) arrangement = kByNumber[i];
}

double Viewer::aspect() const { return double(choices_.sizePx.x) / choices_.sizePx.y; }

double Viewer::durationS() const { return shown_ ? shown_->path.durationS() : 0.0; }

void Viewer::play(double secondsPassed) {
  clockS_ += secondsPassed;
  if (!playing_) return;
  if (durationS() <= 0.0) {
    playing_ = false;
    return;
  }
  timeS_ += secondsPassed;
  setTime(timeS_ > durationS() ? 0.0 : timeS_);
}

void Viewer::build(double secondsPassed) {
  controls_.clear();
  handleKeys();
  play(secondsPassed);
  record(secondsPassed);
  const Overlay overlayBefore = overlay_;
  const std::string displayBefore = options_.display.hash();
  Panes panes(*this);
  panes.build();
  const bool wasMoving = moving_;
  const glm::vec2 size(surface_.sizePx());
  const float left = panesHidden_ ? 0.0F : panes.leftPx(), right = panesHidden_ ? 0.0F : panes.rightPx();
  PicturePane(*this, {left, 0.0F}, {size.x - right, size.y - panes.bottomPx()}).build(secondsPassed);
  // A control that is held: what it shows now is not what it will rest at.
  if (ImGui::IsAnyItemActive() && ImGui::IsMouseDown(ImGuiMouseButton_Left) &&
      !ImGui::GetIO().WantTextInput && !(choices_ == asked_))
    moving_ = true;
  else if (!ImGui::IsMouseDown(ImGuiMouseButton_Left) && !ImGui::IsMouseDown(ImGuiMouseButton_Right) &&
           !ImGui::IsMouseDown(ImGuiMouseButton_Middle) && !flying_)
    moving_ = false;
  const bool otherRequest = !(choices_ == asked_) || view_ != request_.view ||
                            pickedPx_ != request_.pickedPx || continuous_ != request_.continuous ||
                            (moving_ || playing_) != request_.moving || wasMoving != moving_;
  if (otherRequest) ask();
  if (overlay_ != overlayBefore || options_.display.hash() != displayBefore) askJudge();
}

}  // namespace limen::viewer

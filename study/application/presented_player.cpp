// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/presented_player.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <utility>

#include "renderer/gl/window_context.h"
#include "renderer/window/ui_window.h"
#include "study/presentation/presenter.h"
#include "study/stimulus/prepared_stimulus.h"

namespace limen::study {

namespace {

/// The errors that OpenGL has had since the last call, "" for none. A picture made with one cannot be
/// trusted.
std::string takeGlErrors() {
  std::string out;
  // A lost context may give errors without end.
  for (int i = 0; i < 8; ++i) {
    const GLenum error = glGetError();
    if (error == GL_NO_ERROR) break;
    out += fmt::format("{}0x{:04x}", out.empty() ? "" : ", ", error);
  }
  return out;
}

}  // namespace

struct PresentedPlayer::Prepared : PictureSource {
  std::vector<std::unique_ptr<PreparedStimulus>> stimuli;
  Schedule schedule;
  std::function<void()> captureNext;  ///< for the frame in the middle of the first stimulus

  Picture picture(int stimulus, int frame) override {
    if (captureNext && stimulus == 0 && frame == schedule.timelines[0].frames / 2)
      std::exchange(captureNext, {})();
    PreparedStimulus& prepared = *stimuli[static_cast<size_t>(stimulus)];
    const int layer = prepared.picture(frame);
    return {prepared.layers().id(), layer};
  }
};

PresentedPlayer::PresentedPlayer(window::UiWindow& window, const Protocol& protocol,
                                 const perception::DisplayProfile& display, bool anyTiming,
                                 const PhotodiodePatch& patch)
    : window_(window),
      protocol_(protocol),
      display_(display),
      anyTiming_(anyTiming),
      patch_(patch),
      screen_(window, display) {}

PresentedPlayer::~PresentedPlayer() { window_.context().makeCurrent(); }

void PresentedPlayer::checkFit() const {
  for (const Part& part : protocol_.parts) {
    const bool together =
        part.task.type == Task::Alternative || (part.task.type == Task::Pairwise && part.task.sideBySide);
    const int count = !together ? 1 : part.task.type == Task::Pairwise ? 2 : part.task.alternatives;
    placesOf(count, {protocol_.window.widthPx, protocol_.window.heightPx}, window_.sizePx(),
             ScheduleSetting().separationPx);
  }
}

void PresentedPlayer::prepare(const Trial& trial, const Session&, const std::function<void()>& idle) {
  window_.context().makeCurrent();
  takeGlErrors();  // of pages before the trial
  prepared_.reset();
  auto prepared = std::make_unique<Prepared>();
  const glm::ivec2 sizePx(protocol_.window.widthPx, protocol_.window.heightPx);
  // Several stimuli of a trial together have the same budget as one alone.
  const int64_t budget = pictureBudgetBytes() / static_cast<int64_t>(trial.stimuli.size());
  for (const Stimulus& stimulus : trial.stimuli) {
    auto renderer =
        std::make_unique<StimulusRenderer>(window_.context(), stimulus, sizePx, display_, &scenes_);
    prepared->stimuli.push_back(
        std::make_unique<PreparedStimulus>(std::move(renderer), budget, [&](int, int) {
          idle();
          window_.context().makeCurrent();
        }));
  }
  ScheduleSetting setting;
  setting.task = protocol_.parts.at(static_cast<size_t>(trial.plan.part)).task;
  setting.timing = protocol_.timing;
  setting.windowPx = sizePx;
  setting.screenPx = window_.sizePx();
  setting.refreshHz = display_.refreshHz;
  prepared->schedule = makeSchedule(trial.stimuli, setting);
  prepared_ = std::move(prepared);
}

PlayResult PresentedPlayer::play(const std::function<bool()>& goOn) {
  window_.context().makeCurrent();
  PresenterSetting setting;
  setting.background = protocol_.window.background;
  setting.patch = patch_;
  setting.stop = [](const ScreenEvent& event) {
    return event.kind == ScreenEvent::Kind::Close ? std::string("stopped") : std::string();
  };
  if (markers_) setting.mark = [this](MarkerKind kind, int64_t swapNs) { markers_->send(kind, swapNs); };
  screen_.setWatch(goOn);
  if (capture_) prepared_->captureNext = [this] { screen_.captureNext(capture_); };
  Shown shown = present(prepared_->schedule, *prepared_, screen_, setting);
  screen_.setWatch({});
  PlayResult result;
  result.frames = std::move(shown.frames);
  result.stopped = shown.stopped;
  result.endNs = shown.endNs;
  if (!shown.valid && (!anyTiming_ || screen_.lost())) result.invalid = shown.reason;
  // Whatever the times were: nobody knows what was seen.
  window_.context().makeCurrent();
  if (const std::string errors = takeGlErrors(); !errors.empty()) result.invalid = "OpenGL error " + errors;
  return result;
}

nlohmann::json PresentedPlayer::environment() const {
  return {{"paced_by_timer", screen_.pacedByTimer()},
          {"timing_checked", !anyTiming_},
          {"photodiode_patch_px", patch_.sizePx}};
}

}  // namespace limen::study

// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/window_front_end.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiments/base/image.h"
#include "experiments/base/interrupt.h"
#include "renderer/gl/window_context.h"
#include "study/application/question.h"
#include "study/application/resting_pointer.h"
#include "study/application/screens.h"

namespace limen::study {
namespace {

// How long to wait for input before checking clocks again.
constexpr double kPollS = 0.05;
// A covered window may lose its content, and not every system reports that.
constexpr int64_t kRedrawAnywayNs = 1'000'000'000;
// Longer preparation is announced.
constexpr int64_t kPatienceNs = 1'500'000'000;
constexpr double kFeedbackS = 1.0;

// One word or two in the middle for a moment.
class FeedbackPage : public PageScreen {
 public:
  FeedbackPage(bool correct, const Words& words) : correct_(correct), words_(words) {}
  std::string name() const override { return "feedback"; }
  bool over(int64_t nowNs) const {
    return shownNs() && static_cast<double>(nowNs - *shownNs()) * 1e-9 >= kFeedbackS;
  }

 protected:
  Page build(int64_t) const override {
    Page page;
    page.question = correct_ ? words_["feedback_right"] : words_["feedback_wrong"];
    return page;
  }
  void pressed(int, const window::Input&) override {}

 private:
  bool correct_;
  const Words& words_;
};

}  // namespace

WindowFrontEnd::WindowFrontEnd(window::UiWindow& window, StimulusPlayer& player, SessionWatch& watch,
                               ExperimenterWindow* experimenter, Setting setting)
    : window_(window),
      player_(player),
      watch_(watch),
      experimenter_(experimenter),
      setting_(std::move(setting)) {
  player_.setMarkers(setting_.markers);
  if (setting_.screenshots.empty()) return;
  std::filesystem::create_directories(setting_.screenshots);
  player_.setCapture([this] { screenshot("stimulus"); });
}

PageStyle WindowFrontEnd::style() const {
  return {window_.fonts(), window_.scale(), setting_.background, window_.gamepadPresent()};
}

void WindowFrontEnd::announce(const std::string& name) {
  if (setting_.announce) setting_.announce("screen: " + name);
}

void WindowFrontEnd::screenshot(const std::string& name) {
  if (setting_.screenshots.empty()) return;
  const std::string file =
      fmt::format("{}/{:04}_{}_{}.png", setting_.screenshots, screenshots_++, name, ++screenshotsOf_[name]);
  writePng(file, window_.readBack());
}

bool WindowFrontEnd::stopAsked() {
  if (!stopReason_.empty()) return true;
  if (interruptSignal() != 0) stopReason_ = "asked to stop by a signal";
  if (window_.contextLost()) stopReason_ = "the graphics driver was reset";
  if (setting_.markers && !setting_.markers->failure().empty()) stopReason_ = setting_.markers->failure();
  return !stopReason_.empty();
}

WindowFrontEnd::Left WindowFrontEnd::run(PageScreen& screen, const std::function<bool()>& timedOut) {
  screen.hidden();
  watch_.setScreen(screen.name());
  PageLayout layout;
  glm::vec2 cursor(0);
  RestingPointer pointer;
  int64_t drawnNs = 0;
  int marked = 0;
  bool draw = true;
  while (!screen.done()) {
    if (stopAsked()) return Left::StopForNow;
    if (experimenter_) experimenter_->tick(watch_);
    if (experimenter_ && experimenter_->takeAbort()) return Left::EndedByExperimenter;
    if (timedOut && timedOut()) return Left::TimedOut;
    // Nothing is drawn while nothing changes, so that no input waits for a frame before it is time-stamped.
    const Page page = screen.page(window::steadyNs());
    const bool fresh = screen.isNew(), moved = window_.cursorPx() != cursor, counts = !page.status.empty();
    if (fresh) pointer = RestingPointer(window_.cursorPx(), screen.ignoresRestingPointer());
    window_.hideCursor(!pointer.counts(window_.cursorPx()));
    if (draw || fresh || moved || counts || window::steadyNs() - drawnNs > kRedrawAnywayNs) {
      cursor = window_.cursorPx();
      window_.draw(setting_.background, [&] {
        const glm::vec2 nowhere(-1, -1), at = pointer.counts(cursor) ? cursor : nowhere;
        layout = drawPage(page, glm::vec2(window_.sizePx()), at, style());
      });
      if (layout.textPages != page.textPages.count) {
        screen.setTextPages(layout.textPages);
        continue;
      }
      if (fresh) screenshot(screen.name());
      drawnNs = window_.show(fresh ? 1 : 0);
      if (fresh) {
        screen.shown(drawnNs);
        markQuestion(screen, drawnNs, marked);
        announce(screen.name());
      }
    }
    window_.poll(kPollS);
    window_.takeLoss();  // seeing a page later does no harm
    const std::vector<window::Input> inputs = takeInputs();
    draw = !inputs.empty();
    const int turns = screen.turns();
    for (const window::Input& input : inputs) {
      if (input.key == window::kKeyEscape) return Left::Paused;
      const bool mouse = input.device == window::Device::Mouse;
      if (mouse && !pointer.counts({input.xPx, input.yPx})) continue;
      if (screen.turns() == turns) screen.take(input, layout.targets);
    }
    markQuestion(screen, drawnNs, marked);
    if (window_.takeCloseRequest()) return Left::Paused;
  }
  return Left::Done;
}

const Words& WindowFrontEnd::words() const { return protocol_ ? protocol_->words : Words::english(); }

WindowFrontEnd::Left WindowFrontEnd::pause(const std::string& reason) {
  PauseScreen page(protocol_ ? protocol_->texts.pause : std::string(), reason, words());
  watch_.rested();
  const Left left = run(page);
  watch_.rested();
  if (left != Left::Done) return left == Left::Paused ? Left::Done : left;  // Esc also resumes
  switch (page.choice()) {
    case PauseScreen::Choice::StopForNow:
      return Left::StopForNow;
    case PauseScreen::Choice::End:
      return Left::End;
    case PauseScreen::Choice::Continue:
      break;
  }
  return Left::Done;
}

ScreenResult WindowFrontEnd::show(const Screen& screen, const Session& session) {
  protocol_ = &session.protocol();
  watch_.progress(session.trialsDone(), session.trialsInAll());
  watch_.rested();
  const std::unique_ptr<PageScreen> page = pageFor(screen, session);
  Left left = run(*page);
  while (left == Left::Paused && (left = pause({})) == Left::Done) left = run(*page);
  ScreenResult result;
  if (left != Left::Done) {
    result.outcome = left == Left::StopForNow ? Outcome::Paused : Outcome::Aborted;
    result.by = stoppedBy(left);
    result.reason = stopReason_;
    return result;
  }
  if (const auto* consent = dynamic_cast<const ConsentScreen*>(page.get())) {
    result.answers = {{"consent", consent->agreed()}};
  }
  if (const auto* form = dynamic_cast<const FormScreen*>(page.get())) result.answers = form->answers();
  return result;
}

void WindowFrontEnd::drawNeutral(const std::string& status) {
  window_.draw(setting_.background, [&] {
    Page page;
    page.status = status;
    if (!status.empty()) drawPage(page, glm::vec2(window_.sizePx()), {-1, -1}, style());
  });
}

std::vector<window::Input> WindowFrontEnd::takeInputs() {
  std::vector<window::Input> inputs = window_.takeInputs();
  if (!experimenter_) return inputs;
  const std::vector<window::Input> keys = experimenter_->takeKeys();
  inputs.insert(inputs.end(), keys.begin(), keys.end());
  return inputs;
}

bool WindowFrontEnd::watchWindow() {
  window_.poll();
  for (const window::Input& input : takeInputs()) {
    if (input.key == window::kKeyEscape)
      pauseAsked_ = true;
    else
      early_.push_back(input);
  }
  if (window_.takeCloseRequest()) pauseAsked_ = true;
  if (const std::string loss = window_.takeLoss(); !loss.empty()) loss_ = loss;
  return !pauseAsked_ && loss_.empty() && !stopAsked();
}

bool WindowFrontEnd::prepare(const Trial& trial, const Session& session) {
  const int64_t start = window::steadyNs();
  drawNeutral({});
  window_.show();
  bool told = false;
  player_.prepare(trial, session, [&] {
    watchWindow();
    if (told || window::steadyNs() - start < kPatienceNs) return;
    drawNeutral(words()["one_moment"]);
    screenshot("wait");
    window_.show(0);
    told = true;
  });
  return watchWindow();
}

TrialResult WindowFrontEnd::present(const Trial& trial, const Session& session) {
  protocol_ = &session.protocol();
  watch_.progress(session.trialsDone(), session.trialsInAll());
  watch_.began(trial, window::steadyNs());
  if (setting_.markers) setting_.markers->take();
  TrialResult result = attempt(trial, session);
  if (setting_.markers) result.markers = setting_.markers->take();
  watch_.ended(result, window::steadyNs());
  return result;
}

TrialResult WindowFrontEnd::attempt(const Trial& trial, const Session& session) {
  PlayResult played;
  while (true) {
    forget();
    window_.hideCursor(true);
    if (prepare(trial, session)) {
      early_.clear();
      announce("stimulus");
      played = player_.play([this] { return watchWindow(); });
    } else {
      played = {};
      played.stopped = true;
    }
    // Until the stimulus has begun a pause loses nothing: the lead-in is repeated.
    if (!played.stopped || !played.frames.empty()) break;
    if (const Left left = afterStop(); left != Left::Done) return stopped(left);
  }
  TrialResult result;
  result.frames = played.frames;
  if (played.stopped || !loss_.empty()) {
    result.outcome = Outcome::Invalid;
    result.reason = loss_.empty() ? "paused in the middle" : "window lost: " + loss_;
    const Left left = afterStop();
    return left == Left::Done ? result : stopped(left, result);
  }
  const TaskSetting& task = session.protocol().parts.at(static_cast<size_t>(trial.plan.part)).task;
  QuestionScreen question(task, played.endNs, {session.design().answersMirrored, words()});
  const double timeoutS = session.protocol().timing.answerTimeoutS;
  Left left = run(question, [&] { return question.timedOut(window::steadyNs(), timeoutS); });
  if (left == Left::Done && played.invalid.empty()) {
    result.answer = question.answer();
    for (const window::Input& input : early_)
      result.answer->extra["early_inputs"].push_back(
          {{"key", earlyKeyName(task, input)},
           {"device", toText(input.device)},
           {"before_question_s", static_cast<double>(result.answer->questionNs - input.timeNs) * 1e-9}});
    return result;
  }
  result.outcome = Outcome::Invalid;
  result.reason = left == Left::TimedOut ? "no answer in time"
                  : left == Left::Paused ? "paused in the middle"
                                         : played.invalid;
  if (left == Left::Paused) left = pause({});
  return left == Left::Done || left == Left::TimedOut ? result : stopped(left, result);
}

void WindowFrontEnd::markQuestion(const PageScreen& screen, int64_t shownNs, int& marked) {
  const auto* question = dynamic_cast<const QuestionScreen*>(&screen);
  if (!question || !setting_.markers) return;
  if (marked == 0) {
    setting_.markers->send(MarkerKind::Question, shownNs);
    marked = 1;
  }
  const int64_t answeredNs = question->answer().answeredNs;
  if (marked == 1 && answeredNs != 0) {
    setting_.markers->send(MarkerKind::Answer, answeredNs);
    marked = 2;
  }
}

void WindowFrontEnd::forget() {
  early_.clear();
  loss_.clear();
  pauseAsked_ = false;
}

WindowFrontEnd::Left WindowFrontEnd::afterStop() {
  if (stopAsked()) return Left::StopForNow;
  return pause(loss_.empty() ? std::string() : words()["pause_lost"]);
}

TrialResult WindowFrontEnd::stopped(Left left, TrialResult result) const {
  result.outcome = left == Left::StopForNow ? Outcome::Paused : Outcome::Aborted;
  result.by = stoppedBy(left);
  if (result.reason.empty()) result.reason = stopReason_;
  return result;
}

std::string WindowFrontEnd::stoppedBy(Left left) const {
  if (left == Left::EndedByExperimenter) return "experimenter";
  return stopReason_.empty() ? "participant" : "system";
}

std::vector<std::string> WindowFrontEnd::takeNotes() {
  return experimenter_ ? experimenter_->takeNotes() : std::vector<std::string>();
}

void WindowFrontEnd::feedback(bool correct) {
  FeedbackPage page(correct, words());
  run(page, [&] { return page.over(window::steadyNs()); });
}

nlohmann::json WindowFrontEnd::environment() const {
  const gl::DeviceInfo& device = window_.context().device();
  const window::UiMonitor monitor = window_.monitor();
  const glm::ivec2 size = window_.sizePx();
  nlohmann::json facts = {{"front_end", "window"},
                          {"gpu", device.renderer},
                          {"opengl", device.version},
                          {"software_renderer", device.software},
                          {"window_system", window_.windowSystem()},
                          {"monitor", monitor.name},
                          {"monitor_width_px", monitor.sizePx.x},
                          {"monitor_height_px", monitor.sizePx.y},
                          {"monitor_refresh_hz", monitor.refreshHz},
                          {"window_width_px", size.x},
                          {"window_height_px", size.y},
                          {"full_screen", setting_.fullScreen},
                          {"scale", window_.scale()}};
  facts.update(player_.environment());
  facts.update(setting_.facts);
  return facts;
}

}  // namespace limen::study

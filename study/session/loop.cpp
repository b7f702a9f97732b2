// SPDX-License-Identifier: BSD-3-Clause
#include "study/session/loop.h"

#include <fmt/core.h>

#include <cmath>

#include "experiments/base/error.h"
#include "experiments/base/interrupt.h"
#include "study/session/clock.h"
#include "study/session/privacy.h"
#include "study/session/rows.h"

namespace limen::study {
namespace {

constexpr double kClockJumpS = 2.0;  // clocks adjusted by a time server stay well below

// A non-existent step would be stored as an answer that nobody gave.
void checkStep(const std::optional<int>& step, const std::optional<Scale>& scale, const std::string& what) {
  if (!step) return;
  if (!scale || *step < 1 || *step > static_cast<int>(scale->labels.size()))
    throw Error("the front end gave step " + std::to_string(*step) + " as " + what +
                ", which the protocol does not have");
}

nlohmann::json answerData(const Trial& trial, const Part& part, const TrialResult& result) {
  if (!result.answer) throw Error("the front end ended a trial without an answer");
  const Answer& answer = *result.answer;
  checkStep(answer.severity, part.task.severity, "severity");
  checkStep(answer.confidence, part.task.confidence, "confidence");
  if (!std::isfinite(answer.reactionTimeS))
    throw Error("the front end gave a reaction time that is not a number");
  const std::optional<bool> correct = Session::isCorrect(part, trial.plan, answer.answer);
  nlohmann::json data = {{"trial", trial.number},
                         {"attempt", trial.attempt},
                         {"answer", answer.answer},
                         {"outcome", Session::outcomeOf(part, trial.plan, answer.answer)},
                         {"correct", nullptr},
                         {"severity", nullptr},
                         {"confidence", nullptr},
                         {"reaction_time_s", answer.reactionTimeS},
                         {"question_ns", answer.questionNs},
                         {"answered_ns", answer.answeredNs},
                         {"device", answer.device},
                         {"extra", answer.extra}};
  if (correct) data["correct"] = *correct;
  if (answer.severity) data["severity"] = *answer.severity;
  if (answer.confidence) data["confidence"] = *answer.confidence;
  return data;
}

void addMarkers(const std::vector<SentMarker>& markers, nlohmann::json& data) {
  for (const SentMarker& marker : markers)
    data["markers"].push_back({{"marker", limen::toText(marker.kind)},
                               {"code", marker.code},
                               {"due_ns", marker.dueNs},
                               {"sent_ns", marker.sentNs}});
}

}  // namespace

Loop::Loop(Session& session, FrontEnd& frontEnd, Clock& clock, Sink sink,
           std::function<void(const std::string&)> warn, std::optional<LastInstant> last)
    : session_(session),
      frontEnd_(frontEnd),
      clock_(clock),
      sink_(std::move(sink)),
      warn_(std::move(warn)),
      last_(std::move(last)) {}

void Loop::record(EventKind kind, nlohmann::json data, const std::vector<ShownFrame>& frames) {
  now_ = {clock_.utc(), clock_.monotonicNs()};
  addClockJump();
  const Step before = session_.step();
  if (!frames.empty()) data["frames"] = frameDigest(framesOf(frames));
  add(kind, std::move(data), frames);
  addWhatFollows(kind, before);
  sink_.commit();
  last_ = now_;
}

void Loop::add(EventKind kind, nlohmann::json data, const std::vector<ShownFrame>& frames) {
  const Event event{session_.nextEvent(), kind, now_.utc, now_.monotonicNs, std::move(data)};
  sink_.prepare(session_, event, frames);
  session_.apply(event);
}

void Loop::addClockJump() {
  if (!last_) return;
  const std::optional<double> from = utcSeconds(last_->utc), to = utcSeconds(now_.utc);
  if (!from || !to) return;
  const double wallS = *to - *from;
  const double steadyS = static_cast<double>(now_.monotonicNs - last_->monotonicNs) * 1e-9;
  if (std::abs(wallS - steadyS) <= kClockJumpS) return;
  add(EventKind::ClockJump, {{"wall_s", wallS}, {"monotonic_s", steadyS}}, {});
  warn_(
      fmt::format("the wall clock moved by {:.1f} s while {:.1f} s passed: it was set, or the machine slept; "
                  "the session continues; treat its times of day with care",
                  wallS, steadyS));
}

// Follow-up events are logged in the same transaction.
void Loop::addWhatFollows(EventKind kind, const Step& before) {
  const auto note = [&](const std::string& code, nlohmann::json detail) {
    add(EventKind::Note, {{"by", "program"}, {"code", code}, {"detail", std::move(detail)}}, {});
  };
  const bool isScreen = kind == EventKind::ScreenDone && before.screen;
  const Step::Kind now = session_.step().kind;
  if (kind == EventKind::TrialInvalid) {
    ++invalid_;
    const int number = before.trial->number, times = session_.timesInvalid(number);
    if (times > session_.protocol().session.repeatInvalidAtMost)
      note("trial_lost", {{"trial", number}, {"times_invalid", times}});
  }
  if (isScreen && now == Step::Kind::Aborted) {
    if (before.screen->kind == Screen::Kind::Consent)
      add(EventKind::Aborted, {{"by", "participant"}, {"reason", "no consent"}}, {});
    else
      add(EventKind::Aborted, {{"by", "program"}, {"reason", "practice failed"}}, {});
  } else if (isScreen && before.screen->kind == Screen::Kind::PracticeResult && !before.screen->passed) {
    const Step& next = session_.step();
    if (!next.screen || next.screen->kind != Screen::Kind::PracticeStart)
      note("practice_failed", {{"part", before.screen->part}});
  }
  if (kind != EventKind::Finished && now == Step::Kind::Finished)
    add(EventKind::Finished, nlohmann::json::object(), {});
}

void Loop::recordNotes() {
  for (const std::string& note : frontEnd_.takeNotes())
    record(EventKind::Note,
           {{"by", "experimenter"}, {"code", noteCode(note)}, {"detail", nlohmann::json::object()}});
}

bool Loop::run() {
  while (true) {
    const Step::Kind due = session_.step().kind;
    if (due == Step::Kind::Finished || due == Step::Kind::Aborted) return true;
    if (interruptSignal() != 0) {
      record(EventKind::Paused, {{"by", "system"}, {"reason", "asked to stop by a signal"}});
      throwIfInterrupted();
    }
    const bool goesOn = due == Step::Kind::Screen ? showScreen() : presentTrial();
    recordNotes();
    if (!goesOn) return false;
  }
}

bool Loop::showScreen() {
  const Screen screen = *session_.step().screen;
  const ScreenResult result = frontEnd_.show(screen, session_);
  const nlohmann::json why = {{"by", stopper(result.by)}, {"reason", result.reason}};
  switch (result.outcome) {
    case Outcome::Done:
      record(EventKind::ScreenDone, screenData(session_.protocol(), screen, result));
      break;
    case Outcome::Invalid:
      break;  // shown again
    case Outcome::Paused:
      record(EventKind::Paused, why);
      return false;
    case Outcome::Aborted:
      record(EventKind::Aborted, why);
      break;
  }
  return true;
}

bool Loop::presentTrial() {
  const Trial trial = *session_.step().trial;
  const Part& part = session_.protocol().parts[static_cast<size_t>(trial.plan.part)];
  std::vector<std::string> hashes;
  for (const Stimulus& stimulus : trial.stimuli) hashes.push_back(stimulusHash(stimulus));
  record(EventKind::TrialStarted, {{"trial", trial.number},
                                   {"attempt", trial.attempt},
                                   {"procedure_stimulus", trial.procedureStimulus},
                                   {"stimulus_hashes", std::move(hashes)}});
  const TrialResult result = frontEnd_.present(trial, session_);
  if (result.outcome == Outcome::Done) {
    nlohmann::json data = answerData(trial, part, result);
    const nlohmann::json correct = data["correct"];
    addMarkers(result.markers, data);
    record(EventKind::Answered, std::move(data), result.frames);
    if (trial.plan.practice && part.practice.feedback && correct.is_boolean())
      frontEnd_.feedback(correct.get<bool>());
    return true;
  }
  nlohmann::json data = {{"trial", trial.number}, {"attempt", trial.attempt}, {"reason", result.reason}};
  addMarkers(result.markers, data);
  if (result.outcome == Outcome::Invalid) {
    record(EventKind::TrialInvalid, std::move(data), result.frames);
    return true;
  }
  data["by"] = stopper(result.by);
  const bool paused = result.outcome == Outcome::Paused;
  record(paused ? EventKind::Paused : EventKind::Aborted, std::move(data), result.frames);
  return !paused;
}

}  // namespace limen::study

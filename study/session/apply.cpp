// SPDX-License-Identifier: BSD-3-Clause
// How events advance a session.
#include <algorithm>

#include "experiments/base/error.h"
#include "perception/psychometrics/random.h"
#include "study/session/session.h"

namespace limen::study {
namespace {

const std::string kDamaged = "the session's log is damaged, or of another version of Limen";

std::string describe(const Step& step) {
  switch (step.kind) {
    case Step::Kind::Screen:
      return "screen " + toText(step.screen->kind);
    case Step::Kind::Trial:
      return "trial " + std::to_string(step.trial->number) + ", attempt " +
             std::to_string(step.trial->attempt);
    case Step::Kind::Finished:
      return "nothing: the session has finished";
    case Step::Kind::Aborted:
      break;
  }
  return "nothing: the session was aborted";
}

}  // namespace

std::string toText(Screen::Kind kind) {
  switch (kind) {
    case Screen::Kind::Consent:
      return "consent";
    case Screen::Kind::Form:
      return "form";
    case Screen::Kind::Instructions:
      return "instructions";
    case Screen::Kind::PracticeStart:
      return "practice_start";
    case Screen::Kind::PracticeResult:
      return "practice_result";
    case Screen::Kind::BlockStart:
      return "block_start";
    case Screen::Kind::Break:
      return "break";
    case Screen::Kind::Debrief:
      break;
  }
  return "debrief";
}

void Session::refuse(const Event& event, const std::string& why) const {
  throw Error(kDamaged + ": event " + std::to_string(event.number) + " (" + study::toText(event.kind) + ") " +
              why + "; due was " + describe(step_));
}

void Session::apply(const Event& event) {
  if (event.number != nextEvent_) refuse(event, "has not number " + std::to_string(nextEvent_));
  if ((event.number == 0) != (event.kind == EventKind::Started)) refuse(event, "is out of place");
  const bool ended = stage_ == Stage::Finished || stage_ == Stage::Aborted;
  const bool passes = event.kind == EventKind::Continued || event.kind == EventKind::Aborted ||
                      event.kind == EventKind::Note || event.kind == EventKind::ClockJump;
  if (paused_ && !passes) refuse(event, "follows a pause without being continued");
  try {
    switch (event.kind) {
      case EventKind::Started:
        if (event.data.at("protocol_hash") != protocol_.hash) refuse(event, "is of another protocol");
        if (event.data.at("seed") != std::to_string(seed_)) refuse(event, "has another seed");
        if (event.data.at("participant_number") != participantNumber_)
          refuse(event, "is of another participant");
        if (planVersionOf(event.data) != planVersion_) refuse(event, "has another version of the plan");
        if (planVersion_ >= 2 && event.data.at("answers_from_the_left") != answersFromTheLeft())
          refuse(event, "has the answers on other sides");
        break;
      case EventKind::ScreenDone:
        leaveScreen(event);
        break;
      case EventKind::TrialStarted:
        startTrial(event);
        break;
      case EventKind::Answered:
      case EventKind::TrialInvalid:
        endTrial(event);
        break;
      case EventKind::Paused:
        if (ended) refuse(event, "follows the end");
        inProgress_ = false;
        paused_ = true;
        break;
      case EventKind::Continued:
        if (ended) refuse(event, "follows the end");
        inProgress_ = paused_ = false;
        if (event.data.at("policy") == "restart_block" && brokenBlockEvent()) restartStretch();
        break;
      case EventKind::Note:
      case EventKind::ClockJump:
        break;
      case EventKind::Aborted:
        if (stage_ == Stage::Finished) refuse(event, "follows the end");
        inProgress_ = paused_ = false;
        stage_ = Stage::Aborted;
        break;
      case EventKind::Finished:
        if (stage_ != Stage::Finished) refuse(event, "comes too early");
        break;
    }
  } catch (const nlohmann::json::exception&) {
    refuse(event, "lacks required data");
  }
  ++nextEvent_;
  settle();
}

void Session::leaveScreen(const Event& event) {
  if (step_.kind != Step::Kind::Screen || event.data.at("screen") != study::toText(step_.screen->kind))
    refuse(event, "leaves a different screen");
  const bool isLastRound = stretch_ + 1 >= stretches_.size() || !stretches_[stretch_ + 1].practice ||
                           stretches_[stretch_ + 1].part != stretches_[stretch_].part;
  const auto firstOfPart = [&] {
    return stretch_ == 0 || stretches_[stretch_ - 1].part != stretches_[stretch_].part;
  };
  const auto startOf = [](const Stretch& stretch) {
    return stretch.practice ? Stage::PracticeStart : Stage::BlockStart;
  };
  switch (stage_) {
    case Stage::Consent:
      if (event.data.at("answers").value("consent", false))
        stage_ = protocol_.form.empty() ? Stage::Instructions : Stage::Form;
      else
        stage_ = Stage::Aborted;
      break;
    case Stage::Form:
      stage_ = Stage::Instructions;
      break;
    case Stage::Instructions:
      stage_ = startOf(stretches_[stretch_]);
      break;
    case Stage::PracticeStart:
    case Stage::BlockStart:
      stage_ = Stage::Trials;
      break;
    case Stage::Break:
      sinceBreak_ = 0;
      stage_ = !begunAt_ && firstOfPart() ? Stage::Instructions : Stage::Trials;
      break;
    case Stage::PracticeResult:
      if (passed_ || isLastRound) {
        const int part = stretches_[stretch_].part;
        if (!passed_ && protocol_.parts[static_cast<size_t>(part)].practice.stopOnFailure) {
          stage_ = Stage::Aborted;
          break;
        }
        size_t next = stretch_ + 1;
        while (next < stretches_.size() && stretches_[next].practice && stretches_[next].part == part) ++next;
        enter(next, false);
      } else {
        enter(stretch_ + 1, false);
      }
      break;
    default:
      stage_ = Stage::Finished;
      break;
  }
}

void Session::startTrial(const Event& event) {
  if (step_.kind != Step::Kind::Trial || inProgress_) refuse(event, "does not begin the trial that is due");
  const Trial& due = *step_.trial;
  if (event.data.at("trial") != due.number || event.data.at("attempt") != due.attempt)
    refuse(event,
           "begins trial " + event.data.at("trial").dump() + ", attempt " + event.data.at("attempt").dump());
  if (event.data.at("procedure_stimulus").get<std::vector<double>>() != due.procedureStimulus)
    refuse(event, "shows another level than its procedure asks for");
  std::vector<std::string> hashes;
  for (const Stimulus& stimulus : due.stimuli) hashes.push_back(stimulusHash(stimulus));
  if (event.data.at("stimulus_hashes").get<std::vector<std::string>>() != hashes)
    throw Error(
        "trial " + std::to_string(due.number) + " was shown with different stimuli than this program makes",
        protocol_.path, "scenes or techniques have changed; use the version that started the session");
  if (due.plan.procedure >= 0) queue_.front().stimulus = due.procedureStimulus;
  ++attempts_[due.number];
  if (!begunAt_) begunAt_ = event.number;
  inProgress_ = true;
}

void Session::endTrial(const Event& event) {
  if (!inProgress_) refuse(event, "ends no trial");
  const Trial due = *step_.trial;
  if (event.data.at("trial") != due.number || event.data.at("attempt") != due.attempt)
    refuse(event,
           "ends trial " + event.data.at("trial").dump() + ", attempt " + event.data.at("attempt").dump());
  const Part& part = protocol_.parts[static_cast<size_t>(due.plan.part)];
  if (event.kind == EventKind::TrialInvalid) {
    inProgress_ = false;
    ++invalid_[due.number];
    Queued trial = std::move(queue_.front());
    queue_.erase(queue_.begin());
    if (timesInvalid(due.number) <= protocol_.session.repeatInvalidAtMost) requeue(std::move(trial));
    return;
  }
  const std::string answer = event.data.at("answer").get<std::string>();
  const int outcome = outcomeOf(part, due.plan, answer);
  const bool right = isCorrect(part, due.plan, answer).value_or(true);
  // Catch trials and practice are shown at the procedure's level but do not update it.
  if (due.plan.procedure >= 0 && due.plan.change && !due.plan.practice)
    feed(due.plan.procedure, due.procedureStimulus, outcome);
  inProgress_ = false;
  queue_.erase(queue_.begin());
  if (due.plan.practice) {
    right_ += right ? 1 : 0;
    return;
  }
  ++done_;
  ++sinceBreak_;
  dropFinished();
  if (part.breakEveryTrials > 0 && sinceBreak_ >= part.breakEveryTrials && !queue_.empty())
    stage_ = Stage::Break;
}

// Behind at least one other trial, if there is one. The position depends on the number of invalid
// presentations, not on attempts, so that an interruption does not change the order.
void Session::requeue(Queued trial) {
  const int number = trial.slot.trial->number;
  psychometrics::Random random(psychometrics::childSeed(
      seed_, "requeue:" + std::to_string(number) + ":" + std::to_string(timesInvalid(number))));
  const size_t place = queue_.empty() ? 0 : 1 + static_cast<size_t>(random.below(queue_.size()));
  queue_.insert(queue_.begin() + static_cast<std::ptrdiff_t>(place), std::move(trial));
}

}  // namespace limen::study

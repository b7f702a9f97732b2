// SPDX-License-Identifier: BSD-3-Clause
#include "study/session/session.h"

#include <algorithm>

#include "experiments/base/error.h"
#include "perception/psychometrics/random.h"

namespace limen::study {
namespace {

using psychometrics::childSeed;

const Part& partOf(const Protocol& protocol, int part) { return protocol.parts[static_cast<size_t>(part)]; }

}  // namespace

Session::Session(const Protocol& protocol, uint64_t seed, int participantNumber, int planVersion)
    : protocol_(protocol),
      seed_(seed),
      participantNumber_(participantNumber),
      planVersion_(planVersion),
      design_(makeDesign(protocol, seed, participantNumber)) {
  asPlannedBefore(design_, planVersion);
  for (const PlannedProcedure& planned : design_.procedures) {
    settings_.push_back(readProcedure(planned.settings, protocol.path));
    procedures_.push_back(makeProcedure(settings_.back(), planned.seed));
    nexts_.push_back(procedures_.back()->next());
  }
  fed_.resize(procedures_.size());
  makeStretches();
  if (protocol.texts.consent.empty()) stage_ = protocol.form.empty() ? Stage::Instructions : Stage::Form;
  begin(0);
  if (stretches_.empty()) stage_ = Stage::Debrief;
  settle();
}

void Session::makeStretches() {
  size_t rounds = 0;
  for (const PlannedBlock& block : design_.blocks)
    if (block.practice)
      rounds += static_cast<size_t>(std::max(1, partOf(protocol_, block.part).practice.rounds));
  rounds_.reserve(rounds);  // slots point into it
  for (size_t block = 0; block < design_.blocks.size(); ++block) {
    const PlannedBlock& planned = design_.blocks[block];
    const auto add = [&](const PlannedBlock& from) {
      if (from.trials.empty()) return;
      Stretch& stretch = stretches_.emplace_back();
      stretch.part = planned.part;
      stretch.practice = planned.practice;
      for (const PlannedTrial& trial : from.trials)
        stretch.slots.push_back({&trial, static_cast<int>(block)});
    };
    add(planned);
    if (!planned.practice) continue;
    for (int round = 1; round < partOf(protocol_, planned.part).practice.rounds; ++round) {
      PlannedBlock& again = rounds_.emplace_back(makePracticeRound(protocol_, planned.part, seed_, round));
      for (PlannedTrial& trial : again.trials) trial.block = static_cast<int>(block);
      asPlannedBefore(again, planVersion_);
      add(again);
    }
  }
}

nlohmann::json Session::answersFromTheLeft() const {
  nlohmann::json out = nlohmann::json::object();
  for (const Part& part : protocol_.parts)
    for (const size_t i : answersShown(part.task, design_.answersMirrored))
      out[part.name].push_back(part.task.answers[i]);
  return out;
}

int planVersionOf(const nlohmann::json& started) {
  const auto found = started.find("plan_version");
  if (found == started.end()) return 1;
  if (!found->is_number_integer() || *found < 1 || *found > kPlanVersion)
    throw Error("the session was planned by a newer version of Limen, or its log is damaged", {},
                "use the version that it began with");
  return found->get<int>();
}

bool Session::isOver(const Slot& slot) const {
  const int procedure = slot.trial->procedure;
  return procedure >= 0 && !nexts_[static_cast<size_t>(procedure)];
}

void Session::begin(size_t stretch) {
  stretch_ = stretch;
  queue_.clear();
  sinceBreak_ = right_ = 0;
  begunAt_.reset();
  doneBefore_ = done_;
  fedBefore_.clear();
  for (const std::vector<ProcedureTrial>& fed : fed_) fedBefore_.push_back(fed.size());
  if (stretch >= stretches_.size()) return;
  for (const Slot& slot : stretches_[stretch].slots) queue_.push_back({slot, std::nullopt});
}

// Continues with `stretch`, or with the first one after it that has something to show.
void Session::enter(size_t stretch, bool pause) {
  while (stretch < stretches_.size() &&
         std::all_of(stretches_[stretch].slots.begin(), stretches_[stretch].slots.end(),
                     [&](const Slot& slot) { return isOver(slot); }))
    ++stretch;
  const int part = stretches_[stretch_].part;
  begin(stretch);
  if (stretch == stretches_.size()) {
    stage_ = Stage::Debrief;
  } else if (pause) {
    stage_ = Stage::Break;
  } else if (stretches_[stretch].part != part) {
    stage_ = Stage::Instructions;
  } else {
    stage_ = stretches_[stretch].practice ? Stage::PracticeStart : Stage::BlockStart;
  }
}

void Session::endStretch() {
  const Stretch& stretch = stretches_[stretch_];
  if (!stretch.practice) return enter(stretch_ + 1, true);
  passed_ = right_ >= partOf(protocol_, stretch.part).practice.correct;
  stage_ = Stage::PracticeResult;
}

void Session::dropFinished() {
  const auto over = [&](const Queued& trial) { return isOver(trial.slot); };
  queue_.erase(std::remove_if(queue_.begin(), queue_.end(), over), queue_.end());
}

void Session::settle() {
  if (stage_ == Stage::Trials && !inProgress_) {
    dropFinished();
    if (queue_.empty()) endStretch();
  }
  if (stage_ == Stage::Trials && inProgress_) return;  // still the trial that was due
  step_ = Step();
  if (stage_ == Stage::Finished) return;
  if (stage_ == Stage::Aborted) {
    step_.kind = Step::Kind::Aborted;
    return;
  }
  if (stage_ == Stage::Trials) return settleTrial();
  step_.kind = Step::Kind::Screen;
  Screen& screen = step_.screen.emplace();
  switch (stage_) {
    case Stage::Consent:
      screen.kind = Screen::Kind::Consent;
      break;
    case Stage::Form:
      screen.kind = Screen::Kind::Form;
      break;
    case Stage::Instructions:
      screen.kind = Screen::Kind::Instructions;
      break;
    case Stage::PracticeStart:
      screen.kind = Screen::Kind::PracticeStart;
      break;
    case Stage::PracticeResult:
      screen.kind = Screen::Kind::PracticeResult;
      break;
    case Stage::BlockStart:
      screen.kind = Screen::Kind::BlockStart;
      break;
    case Stage::Break:
      screen.kind = Screen::Kind::Break;
      break;
    default:
      screen.kind = Screen::Kind::Debrief;
      break;
  }
  if (stretch_ < stretches_.size()) {
    screen.part = stretches_[stretch_].part;
    screen.block = stretches_[stretch_].slots.front().block;
  } else if (!stretches_.empty()) {
    screen.part = stretches_.back().part;
    screen.block = stretches_.back().slots.back().block;
  }
  if (stage_ == Stage::PracticeResult) screen.passed = passed_;
  if (stage_ == Stage::Break) screen.atLeastS = protocol_.timing.breakAtLeastS;
  screen.trialsDone = done_;
  screen.trialsInAll = trialsInAll();
}

void Session::settleTrial() {
  const Queued& due = queue_.front();
  step_.kind = Step::Kind::Trial;
  Trial& trial = step_.trial.emplace();
  trial.plan = *due.slot.trial;
  trial.number = trial.plan.number;
  const auto begun = attempts_.find(trial.number);
  trial.attempt = begun == attempts_.end() ? 0 : begun->second;
  Variables axes;
  if (trial.plan.procedure >= 0) {
    const size_t procedure = static_cast<size_t>(trial.plan.procedure);
    trial.procedureStimulus = due.stimulus ? *due.stimulus : *nexts_[procedure];
    const std::vector<StimulusDimension>& dimensions = settings_[procedure].stimulus;
    for (size_t i = 0; i < dimensions.size(); ++i) axes[dimensions[i].name] = trial.procedureStimulus[i];
  }
  trial.stimuli = stimuliOf(protocol_, trial.plan, axes);
  trial.seed =
      childSeed(seed_, "trial:" + std::to_string(trial.number) + ":" + std::to_string(trial.attempt));
}

int Session::trialsInAll() const {
  int count = done_;
  const bool counted = stretch_ < stretches_.size() && !stretches_[stretch_].practice;
  if (counted) {
    for (const Queued& trial : queue_) count += isOver(trial.slot) ? 0 : 1;
  }
  for (size_t i = stretch_ + 1; i < stretches_.size(); ++i) {
    if (stretches_[i].practice) continue;
    for (const Slot& slot : stretches_[i].slots) count += isOver(slot) ? 0 : 1;
  }
  return count;
}

int Session::timesInvalid(int trial) const {
  const auto found = invalid_.find(trial);
  return found == invalid_.end() ? 0 : found->second;
}

std::optional<int> Session::brokenBlockEvent() const {
  return stage_ == Stage::Trials || stage_ == Stage::Break ? begunAt_ : std::nullopt;
}

void Session::feed(int procedure, const std::vector<double>& stimulus, int outcome) {
  const size_t index = static_cast<size_t>(procedure);
  procedures_[index]->update(stimulus, outcome);
  fed_[index].push_back({stimulus, outcome});
  nexts_[index] = procedures_[index]->next();
}

// Procedures cannot be rewound: they are recreated and fed the answers from before the block began.
void Session::rebuildProcedures() {
  for (size_t i = 0; i < procedures_.size(); ++i) {
    if (fed_[i].size() == fedBefore_[i]) continue;
    fed_[i].resize(fedBefore_[i]);
    procedures_[i] = makeProcedure(settings_[i], design_.procedures[i].seed);
    for (const ProcedureTrial& trial : fed_[i]) procedures_[i]->update(trial.stimulus, trial.outcome);
    nexts_[i] = procedures_[i]->next();
  }
}

void Session::restartStretch() {
  rebuildProcedures();
  done_ = doneBefore_;
  for (const Slot& slot : stretches_[stretch_].slots) invalid_.erase(slot.trial->number);
  begin(stretch_);
  stage_ = stretches_[stretch_].practice ? Stage::PracticeStart : Stage::BlockStart;
}

nlohmann::json Session::state() const {
  nlohmann::json queue = nlohmann::json::array(), procedures = nlohmann::json::array();
  for (const Queued& trial : queue_) {
    nlohmann::json entry = {{"trial", trial.slot.trial->number}};
    if (trial.stimulus) entry["stimulus"] = *trial.stimulus;
    queue.push_back(std::move(entry));
  }
  for (const std::unique_ptr<Procedure>& procedure : procedures_) procedures.push_back(procedure->state());
  nlohmann::json attempts = nlohmann::json::object(), invalid = nlohmann::json::object();
  for (const auto& [number, count] : attempts_) attempts[std::to_string(number)] = count;
  for (const auto& [number, count] : invalid_) invalid[std::to_string(number)] = count;
  nlohmann::json blockBegun;
  if (begunAt_) blockBegun = *begunAt_;
  return {{"protocol", protocol_.hash},
          {"seed", seed_},
          {"participant_number", participantNumber_},
          {"next_event", nextEvent_},
          {"stage", static_cast<int>(stage_)},
          {"stretch", stretch_},
          {"queue", std::move(queue)},
          {"attempts", std::move(attempts)},
          {"invalid", std::move(invalid)},
          {"in_progress", inProgress_},
          {"paused", paused_},
          {"done", done_},
          {"since_break", sinceBreak_},
          {"right", right_},
          {"passed", passed_},
          {"block_begun_at", std::move(blockBegun)},
          {"done_before", doneBefore_},
          {"fed_before", fedBefore_},
          {"procedures", std::move(procedures)}};
}

}  // namespace limen::study

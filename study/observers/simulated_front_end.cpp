// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/simulated_front_end.h"

#include <algorithm>
#include <cassert>
#include <nlohmann/json.hpp>

#include "perception/psychometrics/random.h"

namespace limen::study {
namespace {

using psychometrics::childSeed;
using psychometrics::Random;

constexpr double kScreenS = 10.0;  // a screen that may be left at once
constexpr double kFeedbackS = 1.0;

double durationS(const Stimulus& stimulus) {
  return stimulus.cue.durationS + stimulus.showings * stimulus.durationS +
         (stimulus.showings - 1) * stimulus.gapS;
}

}  // namespace

Variables axesOf(const std::vector<std::string>& names, const std::vector<double>& stimulus) {
  assert(names.size() == stimulus.size());
  Variables out;
  for (size_t i = 0; i < names.size(); ++i) out[names[i]] = stimulus[i];
  return out;
}

double durationUpToQuestionS(const Timing& timing, const TaskSetting& task,
                             const std::vector<Stimulus>& stimuli) {
  double out = timing.fixationS + timing.afterFixationS;
  const bool oneAfterAnother =
      task.type == Task::Interval || (task.type == Task::Pairwise && !task.sideBySide);
  double longest = 0.0, sum = 0.0;
  for (const Stimulus& stimulus : stimuli) {
    longest = std::max(longest, durationS(stimulus));
    sum += durationS(stimulus);
  }
  if (!oneAfterAnother) return out + longest;
  return out + sum + timing.intervalGapS * (static_cast<double>(stimuli.size()) - 1.0);
}

SimulatedFrontEnd::SimulatedFrontEnd(SimulatedObserver& observer, SimulatedClock& clock,
                                     SimulatedFrontEndSetting setting)
    : observer_(observer), clock_(clock), setting_(std::move(setting)) {}

ScreenResult SimulatedFrontEnd::show(const Screen& screen, const Session& session) {
  ScreenResult out;
  if (setting_.quit && setting_.quit()) {
    out.outcome = Outcome::Paused;
    return out;
  }
  clock_.advance(std::max(screen.atLeastS, kScreenS));
  if (screen.kind == Screen::Kind::Consent) out.answers["consent"] = true;
  if (screen.kind == Screen::Kind::Form)
    for (const FormField& field : session.protocol().form) {
      Random random(childSeed(setting_.seed, "form " + field.name));
      out.answers[field.name] =
          field.choices.empty() ? "" : field.choices[random.below(field.choices.size())];
    }
  return out;
}

TrialResult SimulatedFrontEnd::present(const Trial& trial, const Session& session) {
  TrialResult out;
  if (setting_.quit && setting_.quit()) {
    out.outcome = Outcome::Paused;
    return out;
  }
  const Protocol& protocol = session.protocol();
  const TaskSetting& task = protocol.parts[static_cast<size_t>(trial.plan.part)].task;
  clock_.advance(durationUpToQuestionS(protocol.timing, task, trial.stimuli));
  if (setting_.invalidRate > 0.0 && Random(childSeed(trial.seed, "frames")).chance(setting_.invalidRate)) {
    out.outcome = Outcome::Invalid;
    out.reason = "simulated: missed frames";
    return out;
  }

  Variables axes;
  if (!trial.procedureStimulus.empty()) {
    std::vector<std::string>& names = axisNames_[trial.plan.procedure];
    if (names.empty()) {
      const auto& planned = session.design().procedures[static_cast<size_t>(trial.plan.procedure)];
      for (const StimulusDimension& dimension : readProcedure(planned.settings, "procedure").stimulus)
        names.push_back(dimension.name);
    }
    axes = axesOf(names, trial.procedureStimulus);
  }
  // Of the trial, not of the attempt: one interrupted by a kill is answered as it would have been.
  const uint64_t seed = childSeed(session.seed(), "answer to trial " + std::to_string(trial.number));
  ObserverResponse response = observer_.respond(trial, axes, seed);
  // Simulated observers answer in time.
  if (protocol.timing.answerTimeoutS > 0.0)
    response.reactionTimeS = std::min(response.reactionTimeS, 0.95 * protocol.timing.answerTimeoutS);

  Answer answer;
  answer.answer = response.answer;
  answer.severity = response.severity;
  answer.confidence = response.confidence;
  answer.reactionTimeS = response.reactionTimeS;
  answer.device = "observer";
  answer.extra = {
      {"probability", response.probability}, {"detected", response.detected}, {"lapsed", response.lapsed}};
  answer.questionNs = clock_.monotonicNs();
  clock_.advance(response.reactionTimeS);
  answer.answeredNs = clock_.monotonicNs();
  // Each further question takes the same time again.
  for (const bool asked : {response.severity.has_value(), response.confidence.has_value()})
    if (asked) clock_.advance(response.reactionTimeS);
  clock_.advance(protocol.timing.betweenTrialsS);
  out.answer = answer;
  return out;
}

void SimulatedFrontEnd::feedback(bool /*correct*/) { clock_.advance(kFeedbackS); }

nlohmann::json SimulatedFrontEnd::environment() const {
  nlohmann::json out = {{"front_end", "simulated observer"},
                        {"simulated", true},
                        {"refresh_hz", setting_.refreshHz},
                        {"invalid_rate", setting_.invalidRate}};
  out["observer"] = setting_.description;
  return out;
}

}  // namespace limen::study

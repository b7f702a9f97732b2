// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/session/scripted.h"

#include <fmt/core.h>

#include <chrono>

#include "base/hash.h"
#include "psychometrics/random.h"

namespace limen::study {
namespace {

nlohmann::json staircase() {
  return {{"type", "staircase"},
          {"stimulus", {{"name", "contrast"}, {"start", 8.0}, {"minimum", 1.0}, {"maximum", 16.0}}},
          {"down", 2},
          {"steps", {2.0, 1.0}},
          {"estimate_reversals", 2},
          {"stop", {{"reversals", 4}, {"trials", 12}}}};
}

}  // namespace

void seal(Protocol& protocol) {
  protocol.path = "test.yaml";
  protocol.name = "test";
  protocol.hash = sha256(protocol.text);
}

std::string TestClock::utc() {
  ++wallMs_, ++monotonicMs_;
  const std::chrono::sys_seconds seconds{std::chrono::seconds(wallMs_ / 1000)};
  const auto day = std::chrono::floor<std::chrono::days>(seconds);
  const std::chrono::year_month_day date(day);
  const std::chrono::hh_mm_ss time(seconds - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()),
                     static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     time.hours().count(), time.minutes().count(), time.seconds().count(), wallMs_ % 1000);
}

ScreenResult ScriptedFrontEnd::show(const Screen& screen, const Session&) {
  log.push_back(toText(screen.kind));
  screens.push_back(screen);
  if (screenResult) return screenResult(screen);
  ScreenResult result;
  if (screen.kind == Screen::Kind::Consent) result.answers = {{"consent", true}};
  if (screen.kind == Screen::Kind::Form)
    for (const FormField& field : protocol_.form)
      if (!field.choices.empty()) result.answers[field.name] = field.choices.front();
  return result;
}

TrialResult ScriptedFrontEnd::present(const Trial& trial, const Session& session) {
  log.push_back(fmt::format("{}.{}", trial.number, trial.attempt));
  trials.push_back(trial);
  TrialResult result;
  for (int i = 0; i < frames; ++i)
    result.frames.push_back({0, 0, i, 1000000LL * i + trial.number, i == 2 ? 1 : 0});
  if (trialOutcome) result.outcome = trialOutcome(trial, session);
  if (result.outcome != Outcome::Done) {
    result.reason = "as scripted";
    return result;
  }
  const Part& part = protocol_.parts[static_cast<size_t>(trial.plan.part)];
  const uint64_t drawn = psychometrics::childSeed(99, std::to_string(trial.number));
  const size_t index = answer ? static_cast<size_t>(answer(trial)) : drawn % part.task.answers.size();
  Answer given;
  given.answer = part.task.answers[index];
  if (part.task.severity && index == 0) given.severity = 1 + static_cast<int>(drawn / 7 % 3);
  given.reactionTimeS = static_cast<double>(drawn % 1000) / 999.0;
  given.questionNs = static_cast<int64_t>(drawn % 100000);
  given.answeredNs = given.questionNs + 5;
  given.device = "script";
  result.answer = given;
  return result;
}

int answerIndex(const Part& part, const PlannedTrial& trial, bool right) {
  const bool first = part.task.type == Task::YesNo ? trial.change : trial.target == 0;
  return first == right ? 0 : 1;
}

Protocol smallProtocol(int changes, int catches) {
  Protocol protocol;
  Part part;
  part.name = "only";
  part.task.answers = {"yes", "no"};
  part.changeRepetitions = changes;
  part.catchRepetitions = catches;
  protocol.parts = {part};
  protocol.text = fmt::format("small {} {}", changes, catches);
  seal(protocol);
  return protocol;
}

Protocol largeProtocol() {
  Protocol protocol;
  protocol.texts.consent = "May we?";
  protocol.form = {{"age", "Age", {"18-29", "30-49", "50+"}}, {"remarks", "Remarks", {}}};

  Part direct;
  direct.name = "direct";
  direct.task.answers = {"yes", "no"};
  direct.task.severity = Scale{"How strong?", {"hardly", "clearly", "very"}};
  direct.factors = {{"distance", {{"near", {{"distance", 1}}}, {"far", {{"distance", 2}}}}},
                    {"motion", {{"still", {{"motion", 0}}}, {"moving", {{"motion", 1}}}}}};
  direct.changeRepetitions = 3;
  direct.catchRepetitions = 1;
  direct.blockBy = "motion";
  direct.breakEveryTrials = 5;
  direct.practice.trials = 3;
  direct.practice.correct = 0;

  Part adaptive;
  adaptive.name = "adaptive";
  adaptive.task.type = Task::Interval;
  adaptive.task.answers = {"first", "second"};
  adaptive.factors = {{"sun", {{"low", {{"sun", 1}}}, {"high", {{"sun", 2}}}}}};
  adaptive.catchRepetitions = 0;
  adaptive.procedure = ProcedureSetting{staircase(), {}};

  Part rating;
  rating.name = "rating";
  rating.task.type = Task::Rating;
  rating.task.answers = {"bad", "fair", "good"};
  rating.changeRepetitions = 4;

  protocol.parts = {direct, adaptive, rating};
  protocol.text = "large";
  seal(protocol);
  return protocol;
}

Protocol killedProtocol() {
  Protocol protocol = largeProtocol();
  protocol.session.repeatInvalidAtMost = 1;
  return protocol;
}

// Numbers that are 0, 5, 10, ... are invalid up to three times; after the second they are lost.
Outcome killedOutcome(const Trial& trial, const Session& session) {
  return trial.number % 5 == 0 && session.timesInvalid(trial.number) < trial.number % 4 ? Outcome::Invalid
                                                                                        : Outcome::Done;
}

}  // namespace limen::study

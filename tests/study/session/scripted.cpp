// SPDX-License-Identifier: BSD-3-Clause
#include "tests/study/session/scripted.h"

#include <fmt/core.h>

#include <chrono>

#include "experiments/base/catalogue.h"
#include "perception/psychometrics/random.h"
#include "tests/experiments/base/declare.h"

namespace limen::study {
namespace {

/// What the tests' stimuli may name: one scene, whose every parameter is a number.
std::shared_ptr<const Catalogue> testCatalogue() {
  auto out = std::make_shared<Catalogue>();
  CatalogueEntry scene;
  for (const char* name : {"distance", "motion", "sun", "contrast"})
    scene.parameters.push_back(realParameter(name, 0.0, 0.0, 100.0, "", "a number"));
  out->scenes["test/scene"] = scene;
  return out;
}

const std::string kHead = R"(title: For tests
question: Does a session run?
source: bench
display: desktop_24
window: {width_px: 64, height_px: 48}
texts: {consent: "May we?", instructions: "Look."}
)";

}  // namespace

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
  Protocol protocol = parseProtocol(kHead + fmt::format(R"(task: {{type: yes_no, question: "Seen?"}}
stimulus: {{scene: {{name: test/scene}}, levels: {{before: 1, after: 0}}}}
trials: {{change: {}, catch: {}}}
)",
                                                        changes, catches),
                                    "small.yaml", testCatalogue());
  protocol.texts.consent.clear();
  return protocol;
}

Protocol largeProtocol() {
  Protocol protocol = parseProtocol(kHead + R"(form:
  - {name: age, label: Age, choices: [18-29, 30-49, 50+]}
part_order: fixed
parts:
  - name: direct
    task:
      type: yes_no
      question: "Seen?"
      severity: {question: "How strong?", labels: [hardly, clearly, very]}
    factors: {distance: [1, 2], motion: [0, 1]}
    stimulus:
      scene: {name: test/scene, distance: = distance, motion: = motion}
      levels: {before: 1, after: 0}
    trials: {change: 3, catch: 1}
    blocks: {by: motion}
    breaks: {every_trials: 5}
    practice: {trials: 3}
  - name: adaptive
    task: {type: interval, question: "Which one?"}
    factors: {sun: [1, 2]}
    procedure:
      type: staircase
      stimulus: {name: contrast, start: 8, minimum: 1, maximum: 16}
      down: 2
      steps: [2, 1]
      estimate_reversals: 2
      stop: {reversals: 4, trials: 12}
    stimulus:
      scene: {name: test/scene, sun: = sun, contrast: = contrast}
      levels: {before: 1, after: 0}
  - name: rating
    task: {type: rating, question: "How good?", answers: [bad, fair, good]}
    stimulus: {scene: {name: test/scene}, levels: {before: 1, after: 0}}
    trials: {change: 4}
)",
                                    "large.yaml", testCatalogue());
  // A field without choices, which a front end could offer.
  protocol.form.push_back({"remarks", "Remarks", {}});
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

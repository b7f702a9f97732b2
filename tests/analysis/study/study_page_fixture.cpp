// SPDX-License-Identifier: BSD-3-Clause
#include "tests/analysis/study/study_page_fixture.h"

#include <algorithm>

#include "experiments/store/sessions.h"

namespace limen::analysis {
namespace {

const char* const kHostile = "<b>\"O'Neil\" & co</b>";
const std::string kPageProtocol = R"(title: unused
question: "Is <i>this</i> & \"that\" seen?"
task:
  type: yes_no
  question: "Seen a <change>?"
  answers: ["yes", "no"]
  severity: {question: "How <much>?", labels: [hardly, "<u>so</u>", clearly]}
factors:
  distance: [1, 2, 4]
  presentation: [dynamic, static]
order: {kind: shuffle}
blocks: {by: presentation, order: [dynamic, static]}
practice: {trials: 2, feedback: true}
exclusions: {catch_rate_above: 0.25, reaction_time_below_s: 0.15, blinks_above: 7}
form:
  - {name: age, label: Your age, choices: [young, old]}
)";

const std::string kPageDisplay =
    "name: desk\nresolution_px: [1600, 1200]\nsize_m: [0.4064, 0.3048]\ndistance_m: 0.6\nblack_cd_m2: 0.5\n"
    "peak_cd_m2: 250\ntransfer: srgb\nrefresh_hz: 60\n";

/// Answers of one observer: four trials with a change and two without in each condition.
std::vector<HandMadeTrial> answersOf(size_t observer, bool guesses) {
  std::vector<HandMadeTrial> out;
  size_t number = 0;
  for (const char* distance : {"1", "2", "4"})
    for (const bool dynamic : {true, false}) {
      const std::map<std::string, std::string> condition = {{"distance", distance},
                                                            {"presentation", dynamic ? "dynamic" : "static"}};
      // 2 to 4 of 4 when near, fewer when far or moving; observers differ.
      const int yes = std::clamp(
          static_cast<int>(ratingOf(distance, dynamic)) - static_cast<int>((observer + number) % 3) + 1, 0,
          4);
      std::vector<HandMadeTrial> own = trials(condition, yes, 4);
      for (HandMadeTrial& trial : own)
        if (trial.outcome == 1) trial.severity = 1 + static_cast<int>((observer + number) % 3);
      own = own + trials(condition, guesses ? 2 : (number == observer ? 1 : 0), 2, false);
      for (HandMadeTrial& trial : own) {
        trial.presentation = dynamic ? "dynamic" : "static";
        trial.reactionTimeS = 0.5 + 0.1 * static_cast<double>(number) + 0.05 * static_cast<double>(observer);
      }
      out = out + own;
      ++number;
    }
  return out;
}

}  // namespace

double ratingOf(const std::string& distance, bool dynamic) {
  return 4.0 - std::log2(std::stod(distance)) - (dynamic ? 0.75 : 0.0);
}

void StudyPageTest::addSession(size_t observer, const std::string& code, bool guesses,
                               const nlohmann::json& frontEnd) {
  std::vector<HandMadeTrial> shown = answersOf(observer, guesses);
  if (observer == 0) {
    HandMadeTrial hasty = shown.front(), practice = shown.front(), late = shown.front();
    hasty.reactionTimeS = 0.05;
    practice.practice = true;
    late.valid = false;
    shown = shown + std::vector<HandMadeTrial>{hasty, practice, late};
  }
  addHandMadeSession(store(), code, kPageProtocol, shown, "finished", "1", frontEnd, kHostile, kPageDisplay);
}

void StudyPageTest::addStudy(const nlohmann::json& frontEnd) {
  for (size_t i = 0; i < 4; ++i) addSession(i, codes_[i], false, frontEnd);
  addSession(1, "guesser", true, frontEnd);
}

void StudyPageTest::addPredictions() {
  for (const char* distance : {"1", "2", "4"})
    for (const bool dynamic : {true, false}) {
      HandMadeTrial trial =
          trials({{"distance", distance}, {"presentation", dynamic ? "dynamic" : "static"}}, 1, 1)[0];
      trial.presentation = dynamic ? "dynamic" : "static";
      const double rating = ratingOf(distance, dynamic);
      addHandMadePrediction(store(), handMadeHash(trial),
                            {{"rating", rating},
                             {"detection_probability", 1.0 / (1.0 + std::exp(-(rating - 2.0)))},
                             {"coverage_of_object", 0.02 * rating},
                             {"max_de94", 10.0 - rating},
                             {"regions", {{{"rating", rating}}}}});
    }
}

StudyPageOptions StudyPageTest::options() const {
  StudyPageOptions out = pageOptions();
  out.choice.codes = true;
  return out;
}

std::string StudyPageTest::write() {
  results_ = writeStudyPages(options());
  return readFileBytes(results_.at(0).page);
}

std::vector<AnswerRow> StudyPageTest::rows() const {
  std::vector<AnswerRow> out;
  for (const store::StudySession& session : store::readSessions(store()))
    for (const store::StudyTrial& trial : store::readTrials(store(), session.id)) {
      if (!trial.valid.value_or(false) || trial.practice || trial.superseded ||
          session.participant == "guesser")
        continue;
      if (trial.response->reactionTimeS < 0.15) continue;
      out.push_back({session.participant, trial.condition.at("distance"), trial.condition.at("presentation"),
                     trial.change, trial.response->outcome});
    }
  return out;
}

Moments momentsOf(const std::map<std::string, double>& values) {
  Moments out;
  for (const auto& [name, value] : values) out.mean += value / static_cast<double>(values.size());
  for (const auto& [name, value] : values) out.sd += (value - out.mean) * (value - out.mean);
  out.sd = std::sqrt(out.sd / static_cast<double>(values.size() - 1));
  return out;
}

}  // namespace limen::analysis

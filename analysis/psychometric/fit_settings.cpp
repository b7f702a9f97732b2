// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/fit_settings.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "analysis/psychometric/likelihood.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

std::string placeOf(const std::string& where, const Condition& condition) {
  if (condition.name.empty()) return where;
  return where.empty() ? "condition " + condition.name : where + ", condition " + condition.name;
}

void checkFixed(const FitSettings& settings) {
  const auto& names = fitParameterNames();
  for (size_t i = 0; i < kFitParameters; ++i) {
    if (!settings.fixed[i]) continue;
    const double value = *settings.fixed[i];
    const std::string where = "fixed " + names[i];
    if (settings.shared[i])
      throw Error("a fixed parameter is not shared as well", where, "drop one of the two");
    switch (static_cast<FitParameter>(i)) {
      case FitParameter::Threshold:
        if (!std::isfinite(value) || (settings.logarithmic() && value <= 0.0))
          throw Error("has to be a finite number, above 0 on a logarithmic axis", where);
        break;
      case FitParameter::Width:
        if (!(value > 0.0 && std::isfinite(value))) throw Error("has to be above 0", where);
        break;
      case FitParameter::Guess:
        if (settings.task.kind != FitTask::Kind::YesNo)
          throw Error("the task settles the guess rate", where, "only task yesno takes one");
        [[fallthrough]];
      default:
        if (!(value >= 0.0 && value < 1.0)) throw Error("has to be at least 0 and below 1", where);
    }
  }
  const double guess = settings.task.kind == FitTask::Kind::ForcedChoice
                           ? 1.0 / settings.task.alternatives
                           : settings.fixed[indexOf(FitParameter::Guess)].value_or(0.0);
  double lapse = settings.fixed[indexOf(FitParameter::Lapse)].value_or(0.0);
  if (settings.task.kind == FitTask::Kind::EqualAsymptotes) lapse *= 2.0;
  if (guess + lapse >= 1.0) throw Error("guess and lapse rate have to sum to less than 1", "fixed lapse");
}

void checkSettings(const FitSettings& settings) {
  if (settings.task.kind == FitTask::Kind::ForcedChoice && settings.task.alternatives < 2)
    throw Error("a forced choice has at least 2 alternatives", "task");
  if (!(settings.thresholdLevel > 0.0 && settings.thresholdLevel < 1.0))
    throw Error("has to lie between 0 and 1, both excluded", "threshold level");
  const double lapseLimit = settings.task.kind == FitTask::Kind::EqualAsymptotes ? 0.5 : 1.0;
  if (!(settings.lapseMost > 0.0 && settings.lapseMost < lapseLimit))
    throw Error(fmt::format("has to lie between 0 and {}, both excluded", lapseLimit), "greatest lapse rate");
  if (!(settings.guessMost > 0.0 && settings.guessMost < 1.0))
    throw Error("has to lie between 0 and 1, both excluded", "greatest guess rate");
  if (settings.range) {
    const auto [low, high] = *settings.range;
    if (!std::isfinite(low) || !std::isfinite(high) || !(low < high) ||
        (settings.logarithmic() && low <= 0.0))
      throw Error("has to be two ascending numbers, above 0 on a logarithmic axis", "range of levels");
  }
  checkFixed(settings);
}

}  // namespace

const std::array<std::string, kFitParameters>& fitParameterNames() {
  static const std::array<std::string, kFitParameters> kNames = {"threshold", "width", "guess", "lapse",
                                                                 "eta"};
  return kNames;
}

FitTask readFitTask(const std::string& text, const std::string& where) {
  if (text == "yesno") return {FitTask::Kind::YesNo, 0};
  if (text == "equal") return {FitTask::Kind::EqualAsymptotes, 0};
  if (text == "2afc") return {FitTask::Kind::ForcedChoice, 2};
  if (text.rfind("mafc:", 0) == 0) {
    const std::string digits = text.substr(5);
    if (!digits.empty() && digits.size() < 7 && digits.find_first_not_of("0123456789") == std::string::npos &&
        std::stoi(digits) >= 2)
      return {FitTask::Kind::ForcedChoice, std::stoi(digits)};
    throw Error("'" + text + "' names no number of alternatives", where, "write mafc:4 for four");
  }
  throw Error("no task '" + text + "'", where, suggest(text, {"yesno", "2afc", "mafc:M", "equal"}));
}

std::string nameOf(const FitTask& task) {
  switch (task.kind) {
    case FitTask::Kind::YesNo:
      return "yesno";
    case FitTask::Kind::EqualAsymptotes:
      return "equal";
    case FitTask::Kind::ForcedChoice:
      break;
  }
  return task.alternatives == 2 ? "2afc" : "mafc:" + std::to_string(task.alternatives);
}

void checkFit(const std::vector<Condition>& conditions, const FitSettings& settings,
              const std::string& where) {
  checkSettings(settings);
  if (conditions.empty()) throw Error("there is nothing to fit", where);
  const auto settled = [&](FitParameter parameter) {
    return settings.fixed[indexOf(parameter)] ||
           (settings.shared[indexOf(parameter)] && conditions.size() > 1);
  };
  for (const Condition& condition : conditions) {
    const std::string place = placeOf(where, condition);
    std::set<double> levels;
    bool blanks = false;
    for (size_t i = 0; i < condition.blocks.size(); ++i) {
      const Block& block = condition.blocks[i];
      const std::string at = fmt::format("{}{}block {}", place, place.empty() ? "" : ", ", i + 1);
      if (block.trials < 0 || block.correct < 0 || block.correct > block.trials)
        throw Error(
            fmt::format("{} correct of {} trials is no count of answers", block.correct, block.trials), at);
      if (block.level == kNoStimulus) {
        blanks |= block.trials > 0;
        continue;
      }
      if (!std::isfinite(block.level)) throw Error("the level is not a finite number", at);
      if (settings.logarithmic() && (block.level < 0.0 || (settings.falling && block.level == 0.0)))
        throw Error(fmt::format("level {} has no place on a {}logarithmic axis", block.level,
                                settings.falling ? "falling " : ""),
                    at, "use a linear axis or levels above 0");
      // 0 on a logarithmic axis lies at minus infinity: F = 0 there, whatever the threshold.
      const bool zero = settings.logarithmic() && block.level == 0.0;
      blanks |= zero && block.trials > 0;
      if (block.trials > 0 && !zero) levels.insert(block.level);
    }
    if (levels.empty())
      throw Error(blanks ? "there are no trials but those without a stimulus" : "there are no trials", place);
    const bool both = !settled(FitParameter::Threshold) && !settled(FitParameter::Width);
    if (levels.size() < 2 && both)
      throw Error("one level does not tell threshold and width", place,
                  "measure at two levels or more, or fix one of the two");
    if (levels.size() < 2 && settings.method == FitMethod::MaximumPosterior && !settings.range &&
        (conditions.size() == 1 || !settings.shared[indexOf(FitParameter::Width)]))
      throw Error("the priors need a range, which one level does not have", place,
                  "name the range of levels or use maximum likelihood");
  }
}

bool answersFall(const std::vector<Condition>& conditions, const FitSettings& settings) {
  FitSettings rising = settings;
  rising.falling = false;
  const SigmoidShape shape(rising);
  double sum = 0.0;
  for (const Condition& condition : conditions) sum += covariance(PreparedBlocks(condition, shape));
  return sum < 0.0;
}

}  // namespace limen::analysis

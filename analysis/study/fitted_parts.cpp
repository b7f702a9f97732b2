// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/fitted_parts.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "analysis/output/text_output.h"
#include "experiments/base/error.h"
#include "experiments/base/text.h"

namespace limen::analysis {
namespace {

constexpr const char* kObserver = "observer";

bool isNumeric(const StudyFactor& factor) {
  return factor.levels.size() > 1 &&
         std::all_of(factor.levels.begin(), factor.levels.end(),
                     [](const std::string& level) { return finiteNumber(level).has_value(); });
}

std::vector<std::string> namesOf(const std::vector<StudyFactor>& factors) {
  std::vector<std::string> out;
  for (const StudyFactor& factor : factors) out.push_back(factor.name);
  return out;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string variableOf(const StudyPart& part, const std::string& wanted) {
  const std::string where = "part " + part.name;
  if (!part.isBinary())
    throw Error("its task '" + part.task + "' has no answers that are right or wrong, yes or no", where,
                "name another part with --part");
  const std::vector<std::string> candidates = numericVariables(part);
  if (!wanted.empty()) {
    if (contains(candidates, wanted)) return wanted;
    const bool factor = contains(namesOf(part.factors), wanted);
    throw Error(factor ? "levels of '" + wanted + "' are no numbers" : "has no variable '" + wanted + "'",
                where, candidates.empty() ? "it has no numeric variable" : "--x takes " + join(candidates));
  }
  if (candidates.empty())
    throw Error("has no numeric stimulus variable: no procedure, and no factor whose levels are numbers",
                where, "name another part with --part");
  const size_t axes = static_cast<size_t>(std::count_if(
      part.axes.begin(), part.axes.end(), [](const std::string& axis) { return !axis.empty(); }));
  if (axes == 1 || candidates.size() == 1) return candidates.front();
  if (part.assumed && contains(candidates, part.assumed->variable)) return part.assumed->variable;
  throw Error("has several numeric variables", where, "name one with --x: " + join(candidates));
}

FitTask taskOf(const StudyPart& part) {
  if (part.asksYesNo()) return {FitTask::Kind::YesNo, 0};
  return {FitTask::Kind::ForcedChoice, part.alternatives};
}

/// What conditions are by, in the protocol's order, observers last.
struct Grouping {
  std::vector<const StudyFactor*> factors;
  bool observers = false;
  std::vector<std::string> pooled;  ///< what is not told apart
};

Grouping groupingOf(const StudyPart& part, const std::string& variable,
                    const std::optional<std::vector<std::string>>& by) {
  Grouping out;
  std::vector<std::string> known = namesOf(part.factors);
  known.push_back(kObserver);
  if (by) {
    for (const std::string& name : *by) {
      if (!contains(known, name))
        throw Error("part " + part.name + " has no factor '" + name + "'", "--by", suggest(name, known));
      if (name == variable) throw Error("'" + name + "' is what is fitted", "--by", "leave it out");
    }
    out.observers = contains(*by, kObserver);
  }
  for (const StudyFactor& factor : part.factors) {
    if (factor.name == variable) continue;
    if (!by || contains(*by, factor.name))
      out.factors.push_back(&factor);
    else
      out.pooled.push_back(factor.name);
  }
  for (const std::string& axis : part.axes)
    if (!axis.empty() && axis != variable) out.pooled.push_back(axis);
  return out;
}

double levelOf(const StudyAnswer& answer, const StudyPart& part, const std::string& variable) {
  if (!answer.change) return kNoStimulus;
  const auto axis = std::find(part.axes.begin(), part.axes.end(), variable);
  if (axis != part.axes.end()) {
    const size_t place = static_cast<size_t>(axis - part.axes.begin());
    if (place < answer.axes.size()) return answer.axes[place];
    throw Error("an answer lacks the value of '" + variable + "' that the procedure asked for",
                "part " + part.name);
  }
  const auto own = answer.condition.find(variable);
  const std::optional<double> value =
      own == answer.condition.end() ? std::nullopt : finiteNumber(own->second);
  if (!value) throw Error("an answer has no number for '" + variable + "'", "part " + part.name);
  return *value;
}

/// Places of an answer's condition among those of the grouping, for sorting, and its name.
std::pair<std::vector<size_t>, std::string> groupOf(const StudyAnswers& study, const StudyAnswer& answer,
                                                    const Grouping& grouping) {
  std::vector<size_t> places;
  std::vector<std::string> words;
  for (const StudyFactor* factor : grouping.factors) {
    const auto own = answer.condition.find(factor->name);
    const std::string level = own == answer.condition.end() ? "" : own->second;
    places.push_back(static_cast<size_t>(std::find(factor->levels.begin(), factor->levels.end(), level) -
                                         factor->levels.begin()));
    words.push_back(factor->name + "=" + level);
  }
  if (grouping.observers) {
    places.push_back(answer.observer);
    words.push_back(std::string(kObserver) + "=" + study.observers[answer.observer]);
  }
  return {places, join(words)};
}

std::map<std::string, std::string> levelsIn(const StudyAnswers& study, const StudyAnswer& answer,
                                            const Grouping& grouping) {
  std::map<std::string, std::string> out;
  for (const StudyFactor* factor : grouping.factors)
    if (const auto own = answer.condition.find(factor->name); own != answer.condition.end()) out.insert(*own);
  if (grouping.observers) out[kObserver] = study.observers[answer.observer];
  return out;
}

void take(const StudyAnswer& answer, double level, Condition& condition) {
  auto block = std::find_if(condition.blocks.begin(), condition.blocks.end(),
                            [&](const Block& one) { return one.level == level; });
  if (block == condition.blocks.end())
    block = condition.blocks.insert(condition.blocks.end(), Block{level, 0, 0, 0.0});
  block->correct += answer.outcome == 1 ? 1 : 0;
  ++block->trials;
  // The mean place of its trials in their sessions.
  block->order += (answer.trial - block->order) / static_cast<double>(block->trials);
}

FittedPart fittedPart(const StudyAnswers& study, size_t index, const std::string& variable,
                      const FittedPartsChoice& choice) {
  const StudyPart& part = study.plan.parts[index];
  const Grouping grouping = groupingOf(part, variable, choice.by);
  FittedPart out;
  out.part = index;
  out.variable = variable;
  out.choice = choice;
  out.choice.part = part.name;
  out.choice.variable = variable;
  out.task = taskOf(part);
  std::map<std::vector<size_t>, Condition> conditions;
  std::map<std::vector<size_t>, std::map<std::string, std::string>> levels;
  std::vector<bool> seen(study.observers.size());
  Block catches;
  for (const StudyAnswer& answer : study.answers) {
    if (answer.part != index) continue;
    if (!answer.change) {
      // A forced choice without a change has no right answer.
      if (!part.asksYesNo()) continue;
      catches.correct += answer.outcome == 1 ? 1 : 0;
      ++catches.trials;
      if (choice.guessFromCatch) continue;
    }
    seen[answer.observer] = true;
    auto [places, name] = groupOf(study, answer, grouping);
    Condition& condition = conditions[places];
    condition.name = name;
    levels[places] = levelsIn(study, answer, grouping);
    take(answer, levelOf(answer, part, variable), condition);
  }
  for (auto& [places, condition] : conditions) {
    std::sort(condition.blocks.begin(), condition.blocks.end(),
              [](const Block& a, const Block& b) { return a.level < b.level; });
    out.conditions.push_back(std::move(condition));
    out.levels.push_back(levels[places]);
  }
  if (out.conditions.empty()) throw Error("has no answers", "part " + part.name);
  if (choice.guessFromCatch && part.asksYesNo()) {
    if (catches.trials == 0)
      throw Error("part " + part.name + " has no catch trials", "--guess", "let it be fitted: --guess free");
    if (grouping.observers)
      throw Error("is one rate for all conditions, and observers have rates of their own", "--guess catch",
                  "let it be fitted with each one's catch trials: --guess free");
    out.guess = static_cast<double>(catches.correct) / static_cast<double>(catches.trials);
    out.notes.push_back(fmt::format("guess rate held at that of catch trials, yes in {} of {}",
                                    catches.correct, catches.trials));
  } else if (catches.trials > 0) {
    out.notes.push_back(
        fmt::format("{} catch trials are in the fit, as trials without a stimulus", catches.trials));
  }
  const auto observers = std::count(seen.begin(), seen.end(), true);
  if (!grouping.pooled.empty()) out.notes.push_back("pooled over " + join(grouping.pooled));
  if (!grouping.observers && observers > 1) {
    out.pooledObservers = static_cast<size_t>(observers);
    out.notes.push_back(
        fmt::format("answers of {} observers pooled: the function is that of their mixture, wider than each "
                    "one's where their thresholds differ",
                    observers));
  }
  if (contains(part.axes, variable))
    out.notes.push_back(
        "a procedure chose the levels by earlier answers; samples of bootstrap and goodness of fit take them "
        "as given");
  return out;
}

}  // namespace

FitSettings ownFitSettings(const StudyPart& part, const FittedPart& fitted) {
  FitSettings settings;
  settings.task = fitted.task;
  if (part.assumed && part.assumed->variable == fitted.variable) {
    settings.sigmoid = psychometrics::sigmoidFamily(part.assumed->sigmoid, part.name);
    settings.axis = part.assumed->axis == "log" ? psychometrics::StimulusAxis::Logarithmic
                                                : psychometrics::StimulusAxis::Linear;
    settings.falling = part.assumed->direction == "falling";
    settings.thresholdLevel = part.assumed->level;
  } else {
    settings.falling = answersFall(fitted.conditions, settings);
  }
  return settings;
}

void shareAllButThreshold(FitSettings& settings, size_t conditions) {
  const auto share = [&](FitParameter parameter) {
    settings.shared[indexOf(parameter)] = conditions > 1 && !settings.fixed[indexOf(parameter)];
  };
  share(FitParameter::Width);
  share(FitParameter::Lapse);
  if (settings.task.kind == FitTask::Kind::YesNo) share(FitParameter::Guess);
}

std::vector<std::string> numericVariables(const StudyPart& part) {
  std::vector<std::string> out;
  for (const std::string& axis : part.axes)
    if (!axis.empty()) out.push_back(axis);
  for (const StudyFactor& factor : part.factors)
    if (isNumeric(factor)) out.push_back(factor.name);
  return out;
}

std::vector<FittedPart> fittedParts(const StudyAnswers& study, const FittedPartsChoice& choice) {
  const std::vector<StudyPart>& parts = study.plan.parts;
  std::vector<std::string> known;
  for (const StudyPart& part : parts) known.push_back(part.name);
  if (!choice.part.empty() && !contains(known, choice.part))
    throw Error("no part '" + choice.part + "'", "--part", suggest(choice.part, known));
  std::vector<FittedPart> out;
  std::vector<std::string> reasons;
  for (size_t i = 0; i < parts.size(); ++i) {
    if (!choice.part.empty() && parts[i].name != choice.part) continue;
    std::string variable;
    try {
      variable = variableOf(parts[i], choice.variable);
    } catch (const Error& error) {
      if (!choice.part.empty() || parts.size() == 1) throw;
      reasons.push_back(error.what());
      continue;
    }
    out.push_back(fittedPart(study, i, variable, choice));
  }
  if (out.empty()) throw Error("no part can be fitted", study.plan.name, join(reasons, "; "));
  for (const std::string& reason : reasons) out.front().notes.push_back("not fitted: " + reason);
  return out;
}

}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/measures.h"

#include <cmath>
#include <set>

#include "analysis/statistics/summary.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

const std::vector<std::string>& measureNames() {
  static const std::vector<std::string> kNames = {"detection_rate", "share_right", "mean_rating",
                                                  "mean_severity", "median_reaction_time_s"};
  return kNames;
}

bool isShare(const std::string& measure) { return measure == "detection_rate" || measure == "share_right"; }

std::string outcomeMeasure(const StudyPart& part) {
  return part.asksYesNo() ? "detection_rate" : part.task == "rating" ? "mean_rating" : "share_right";
}

/// Means of quotients that are equal must stay equal, or ties would be lost to rounding.
double rounded(double value) { return std::round(value * 1e12) / 1e12; }

/// What one condition's answers sum up to.
struct Sums {
  std::map<size_t, std::pair<double, double>> outcomes;  ///< of each observer: sum, answers
  double severity = 0.0, severities = 0.0;
  std::vector<double> reactionTimes;
  std::map<std::string, std::pair<double, double>> predictors;

  void add(const StudyAnswer& answer, bool binary) {
    auto& [sum, count] = outcomes[answer.observer];
    sum += binary ? (answer.outcome == 1 ? 1.0 : 0.0) : answer.outcome;
    count += 1.0;
    reactionTimes.push_back(answer.reactionTimeS);
    if (answer.outcome == 1 && answer.severity) severity += *answer.severity, severities += 1.0;
  }

  void write(ConditionMeasures& out, const std::string& outcome) const {
    double means = 0.0;
    for (const auto& [observer, own] : outcomes) means += own.first / own.second;
    out.measures[outcome] = rounded(means / static_cast<double>(outcomes.size()));
    if (severities > 0.0) out.measures["mean_severity"] = rounded(severity / severities);
    out.measures["median_reaction_time_s"] = quantile(reactionTimes, 0.5);
    for (const auto& [name, own] : predictors) out.predictors[name] = rounded(own.first / own.second);
  }
};

/// A pair of columns of the conditions that have both.
template <class X, class Y>
void addRelation(CorrelationGroup& group, const std::string& x, const std::string& y, bool rates,
                 const std::vector<ConditionMeasures>& conditions, X xOf, Y yOf,
                 const CorrelationSetting& setting) {
  Relation relation;
  relation.x = x;
  relation.y = y;
  relation.rates = rates;
  for (const ConditionMeasures& one : conditions) {
    const std::optional<double> a = xOf(one), b = yOf(one);
    if (!a || !b) continue;
    relation.xs.push_back(*a);
    relation.ys.push_back(*b);
  }
  if (relation.xs.empty()) return;
  correlate(relation, {}, setting);
  group.relations.push_back(std::move(relation));
}

std::optional<double> valueIn(const std::map<std::string, double>& values, const std::string& name) {
  const auto found = values.find(name);
  return found == values.end() ? std::nullopt : std::optional<double>(found->second);
}

auto measureOf(const std::string& name) {
  return [name](const ConditionMeasures& one) { return valueIn(one.measures, name); };
}

void relate(CorrelationGroup& group, const std::vector<ConditionMeasures>& conditions,
            const CorrelationSetting& setting) {
  const auto& names = measureNames();
  for (size_t i = 0; i < names.size(); ++i)
    for (size_t j = i + 1; j < names.size(); ++j)
      addRelation(group, names[j], names[i], false, conditions, measureOf(names[j]), measureOf(names[i]),
                  setting);
  for (const std::string& name : names) {
    if (!isShare(name)) continue;
    // The same condition at rest, set against the one in motion.
    std::map<std::vector<size_t>, double> atRest;
    for (const ConditionMeasures& one : conditions)
      if (const auto value = valueIn(one.measures, name); value && one.presentation == "static")
        atRest[one.levels] = *value;
    const auto still = [&](const ConditionMeasures& one) -> std::optional<double> {
      const auto found = atRest.find(one.levels);
      if (one.presentation != "dynamic" || found == atRest.end()) return {};
      return found->second;
    };
    addRelation(group, name + ", static", name + ", dynamic", false, conditions, still, measureOf(name),
                setting);
    for (const PredictorName& predictor : studyPredictors())
      addRelation(
          group, predictor.name, name, true, conditions,
          [&](const ConditionMeasures& one) { return valueIn(one.predictors, predictor.name); },
          measureOf(name), setting);
  }
}

}  // namespace

std::vector<ConditionMeasures> measureConditions(const StudyAnswers& study, size_t part,
                                                 const ChosenPredictions& predictions,
                                                 const std::map<std::string, std::string>& displays) {
  const StudyPart& plan = study.plan.parts[part];
  std::map<std::pair<std::vector<size_t>, std::string>, Sums> all;
  for (const StudyAnswer& answer : study.answers) {
    if (answer.part != part || !answer.change) continue;
    std::vector<size_t> levels = levelsOf(plan, answer.condition);
    std::string presentation = answer.presentation;
    for (size_t i = 0; i < levels.size(); ++i)
      if (const auto own = answer.condition.find("presentation");
          plan.factors[i].name == "presentation" && own != answer.condition.end()) {
        presentation = own->second;
        levels[i] = 0;
      }
    Sums& sums = all[{levels, presentation}];
    sums.add(answer, plan.isBinary());
    const auto display = displays.find(answer.displayHash);
    if (display == displays.end()) continue;
    const auto values = predictions.values.find({answer.stimulusHash, display->second});
    if (values == predictions.values.end()) continue;
    for (const auto& [name, value] : values->second) {
      sums.predictors[name].first += value;
      sums.predictors[name].second += 1.0;
    }
  }
  std::vector<ConditionMeasures> out;
  for (const auto& [key, sums] : all) {
    out.push_back({key.first, key.second, {}, {}});
    sums.write(out.back(), outcomeMeasure(plan));
  }
  return out;
}

Correlations correlateMeasures(const StudyAnswers& study,
                               const std::vector<store::StudyPrediction>& predictions,
                               const std::map<std::string, std::string>& displayNames,
                               const CorrelationSetting& setting) {
  Correlations out{setting, "", "conditions", {}, {}};
  std::map<std::string, std::string> displays;
  std::set<PredictionKey> wanted;
  for (const StudyAnswer& answer : study.answers) {
    if (!answer.change || !study.plan.parts[answer.part].asksYesNo()) continue;
    displays[answer.displayHash] = wantedDisplay(answer.displayHash, displayNames, {});
    wanted.insert({answer.stimulusHash, displays[answer.displayHash]});
  }
  ChosenPredictions chosen;
  if (predictions.empty() && !wanted.empty()) {
    out.notes.push_back("no predictors: limen study predict makes predictions");
  } else if (!wanted.empty()) {
    try {
      chosen = choosePredictions(predictions, study.plan, wanted, {});
    } catch (const Error& error) {
      out.notes.push_back("predictors are left out: " + error.message());
    }
  }
  for (size_t part = 0; part < study.plan.parts.size(); ++part) {
    const StudyPart& plan = study.plan.parts[part];
    if (!plan.isBinary() && plan.task != "rating") {
      out.notes.push_back("part '" + plan.name +
                          "' compares pairs, which makes a scale (limen analyse scale)");
      continue;
    }
    CorrelationGroup group{study.plan.parts.size() > 1 ? "part=" + plan.name : "", 0, {}, {}};
    if (plan.adaptive)
      group.notes.push_back("a procedure chose the stimuli, so that rates say more of it than of observers");
    relate(group, measureConditions(study, part, chosen, displays), setting);
    if (group.relations.empty()) continue;
    adjustGroup(group);
    out.groups.push_back(std::move(group));
  }
  if (out.groups.empty())
    throw Error("no part has measures that could be set against each other", study.plan.name,
                out.notes.empty() ? "" : out.notes.front());
  return out;
}

}  // namespace limen::analysis

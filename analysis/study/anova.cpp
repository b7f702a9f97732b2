// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/analyses.h"

#include <algorithm>
#include <set>

#include "analysis/study/varying_factors.h"

namespace limen::analysis {

std::vector<NamedFactor> varyingFactors(const StudyPart& part,
                                        const std::vector<ConditionLevels>& conditions) {
  std::vector<NamedFactor> out;
  for (const StudyFactor& factor : part.factors) {
    std::set<std::string> shown;
    for (const ConditionLevels& condition : conditions)
      if (const auto own = condition.find(factor.name); own != condition.end()) shown.insert(own->second);
    NamedFactor varying{factor.name, {}};
    for (const std::string& level : factor.levels)
      if (shown.erase(level) > 0) varying.levels.push_back(level);
    varying.levels.insert(varying.levels.end(), shown.begin(), shown.end());
    if (varying.levels.size() > 1) out.push_back(std::move(varying));
  }
  return out;
}

std::optional<std::vector<size_t>> cellOf(const std::vector<NamedFactor>& factors,
                                          const ConditionLevels& condition) {
  std::vector<size_t> out;
  for (const NamedFactor& factor : factors) {
    const auto own = condition.find(factor.name);
    if (own == condition.end()) return {};
    const auto level = std::find(factor.levels.begin(), factor.levels.end(), own->second);
    out.push_back(static_cast<size_t>(level - factor.levels.begin()));
  }
  return out;
}

namespace {

PartAnova anovaOf(const StudyAnswers& study, const StudyPart& part,
                  const std::vector<const StudyAnswer*>& answers, const AnovaSettings& settings) {
  PartAnova out;
  out.part = part.name;
  out.of = part.asksYesNo() ? "yes" : "right";
  out.measure = "rate of '" + out.of + "' in trials with a change";
  if (!part.isBinary()) {
    out.note = "answers are not one of two";
    return out;
  }
  if (part.adaptive) {
    out.note = "a procedure chose the stimuli: limen analyse thresholds compares what it is for";
    return out;
  }
  std::vector<ConditionLevels> conditions;
  for (const StudyAnswer* answer : answers) conditions.push_back(answer->condition);
  GroupObservations data{varyingFactors(part, conditions), study.observers, {}};
  if (data.factors.empty()) {
    out.note = "no factor has two levels";
    return out;
  }
  for (const StudyAnswer* answer : answers)
    if (const auto cell = cellOf(data.factors, answer->condition))
      data.observations.push_back({answer->observer, *cell, answer->outcome == 1 ? 1.0 : 0.0});
  analyseGroup(out, data, settings);
  for (size_t i = 0; i < out.published.size(); ++i) {
    std::vector<std::string> names;
    for (const size_t factor : out.result->effects[i].factors) names.push_back(out.factors[factor].name);
    out.published[i] = publishedEffect(study.plan.name, part.name, names);
  }
  return out;
}

}  // namespace

std::vector<PartAnova> studyAnova(const StudyAnswers& study, const AnovaSettings& settings) {
  std::vector<PartAnova> out;
  for (size_t part = 0; part < study.plan.parts.size(); ++part) {
    std::vector<const StudyAnswer*> answers;
    for (const StudyAnswer& answer : study.answers)
      if (answer.part == part && answer.change) answers.push_back(&answer);
    if (!answers.empty()) out.push_back(anovaOf(study, study.plan.parts[part], answers, settings));
  }
  return out;
}

}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "analysis/study/rates.h"

namespace limen::analysis {
namespace {

struct Scenario {
  std::map<size_t, std::pair<int64_t, int64_t>> observers;  // positive answers and trials
  std::vector<double> severities;
};

Spread spreadOf(const std::vector<double>& values) {
  Spread out;
  out.scenarios = values.size();
  const auto n = static_cast<double>(values.size());
  out.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - out.mean) * (value - out.mean);
  out.sdOfN = std::sqrt(squares / n);
  if (values.size() > 1) out.sd = std::sqrt(squares / (n - 1.0));
  return out;
}

}  // namespace

void addScenarioSpreads(const StudyAnswers& study, size_t part, StudyRates& out) {
  using Condition = std::map<std::string, std::string>;
  std::map<std::string, std::map<Condition, Scenario>> kinds;
  for (const StudyAnswer& answer : study.answers) {
    if (answer.part != part || !answer.change) continue;
    Scenario& scenario = kinds[answer.presentation][answer.condition];
    auto& [positive, trials] = scenario.observers[answer.observer];
    positive += answer.outcome == 1 ? 1 : 0;
    ++trials;
    if (answer.outcome == 1 && answer.severity) scenario.severities.push_back(*answer.severity);
  }
  for (const auto& [presentation, scenarios] : kinds) {
    std::vector<double> rates, severities;
    for (const auto& [condition, scenario] : scenarios) {
      double sum = 0.0;
      for (const auto& [observer, count] : scenario.observers)
        sum += static_cast<double>(count.first) / static_cast<double>(count.second);
      rates.push_back(sum / static_cast<double>(scenario.observers.size()));
      if (!scenario.severities.empty()) severities.push_back(spreadOf(scenario.severities).mean);
    }
    ScenarioSpread one;
    one.part = study.plan.parts[part].name;
    one.presentation = kinds.size() > 1 ? presentation : "all";
    one.of = study.plan.parts[part].asksYesNo() ? "yes" : "right";
    one.rate = spreadOf(rates);
    if (!severities.empty()) one.severity = spreadOf(severities);
    one.published = publishedScenario(study.plan.name, one.part, presentation);
    out.scenarios.push_back(std::move(one));
  }
}

}  // namespace limen::analysis

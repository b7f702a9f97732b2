// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/rates.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "analysis/statistics/within_subjects.h"
#include "analysis/study/link.h"

namespace limen::analysis {

namespace {

struct ScenarioAnswers {
  ObserverCounts observers;
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
  using ConditionKey = std::map<std::string, std::string>;
  std::map<std::string, std::map<ConditionKey, ScenarioAnswers>> kinds;
  for (const StudyAnswer& answer : study.answers) {
    if (answer.part != part || !answer.change) continue;
    ScenarioAnswers& scenario = kinds[answer.presentation][answer.condition];
    scenario.observers[answer.observer].yes += answer.outcome == 1 ? 1 : 0;
    ++scenario.observers[answer.observer].trials;
    if (answer.outcome == 1 && answer.severity) scenario.severities.push_back(*answer.severity);
  }
  for (const auto& [presentation, scenarios] : kinds) {
    std::vector<double> rates, severities;
    for (const auto& [condition, scenario] : scenarios) {
      rates.push_back(meanRate(scenario.observers));
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

namespace {

struct Count {
  int64_t positive = 0, trials = 0;
};

/// Groups of answers in the order of the part's factors and levels.
struct Group {
  RateScope scope;
  std::map<std::string, std::string> condition;
  std::map<size_t, Count> observers;
};

using GroupKey = std::pair<int, std::vector<size_t>>;

class PartRates {
 public:
  PartRates(const StudyAnswers& study, size_t part) : study_(study), part_(study.plan.parts[part]) {
    std::set<std::string> presentations;
    for (const StudyAnswer& answer : study.answers)
      if (answer.part == part) presentations.insert(answer.presentation);
    const bool named = std::any_of(part_.factors.begin(), part_.factors.end(),
                                   [](const StudyFactor& f) { return f.name == "presentation"; });
    byStimulus_ = !named && presentations.size() > 1;
    std::set<std::string> shown;
    for (const StudyAnswer& answer : study.answers)
      if (answer.part == part && !answer.catchShows.empty()) shown.insert(answer.catchShows);
    byCatch_ = shown.size() > 1;
    for (const StudyAnswer& answer : study.answers)
      if (answer.part == part) add(answer);
  }

  void rows(double level, StudyRates& out) const {
    const std::map<GroupKey, std::optional<Interval>> within = withinObservers(level);
    for (const auto& [key, group] : groups_[1]) {
      const bool change = true;
      out.rows.push_back(row(group, change, level));
      if (const auto own = within.find(key); own != within.end()) out.rows.back().within = own->second;
      const auto catches = groups_[0].find(key);
      if (catches != groups_[0].end()) out.rows.push_back(row(catches->second, false, level));
    }
    for (const auto& [key, group] : groups_[0])
      if (!groups_[1].count(key)) out.rows.push_back(row(group, false, level));
  }

  void observers(double level, StudyRates& out) const {
    const GroupKey whole{0, {}};
    const auto change = groups_[1].find(whole), catches = groups_[0].find(whole);
    if (change == groups_[1].end()) return;
    for (const auto& [observer, count] : change->second.observers) {
      ObserverRate one{part_.name, study_.observers[observer], of(), {}, {}};
      one.change = detectionRate(count.positive, count.trials, level);
      if (catches != groups_[0].end())
        if (const auto own = catches->second.observers.find(observer); own != catches->second.observers.end())
          one.catches = detectionRate(own->second.positive, own->second.trials, level);
      out.observers.push_back(one);
    }
  }

 private:
  /// Of the levels of each factor, and of the conditions.
  std::map<GroupKey, std::optional<Interval>> withinObservers(double level) const {
    std::map<std::pair<int, size_t>, std::vector<GroupKey>> families;
    for (const auto& [key, group] : groups_[1])
      if (key.first > 0) families[{key.first, key.first == 1 ? key.second.front() : 0}].push_back(key);
    std::map<GroupKey, std::optional<Interval>> out;
    for (const auto& [name, keys] : families) {
      std::vector<std::vector<double>> rates;
      for (const GroupKey& key : keys) {
        const auto& observers = groups_[1].at(key).observers;
        rates.emplace_back();
        for (const auto& [observer, count] : groups_[1].at(keys.front()).observers)
          if (const auto own = observers.find(observer); own != observers.end())
            rates.back().push_back(static_cast<double>(own->second.positive) /
                                   static_cast<double>(own->second.trials));
        if (rates.back().size() != observers.size() || observers.size() != rates.front().size())
          rates.clear();
        if (rates.empty()) break;
      }
      if (rates.empty()) continue;
      const auto intervals = withinSubjectIntervals(rates, true, level);
      for (size_t i = 0; i < keys.size(); ++i) out[keys[i]] = intervals[i];
    }
    return out;
  }

  std::string of() const { return part_.asksYesNo() ? "yes" : "right"; }

  void count(const GroupKey& key, RateScope scope, const std::map<std::string, std::string>& condition,
             const StudyAnswer& answer) {
    Group& group = groups_[answer.change ? 1 : 0].try_emplace(key, Group{scope, condition, {}}).first->second;
    Count& own = group.observers[answer.observer];
    ++own.trials;
    own.positive += answer.outcome == 1 ? 1 : 0;
  }

  void add(const StudyAnswer& answer) {
    count({0, {}}, RateScope::Part, {}, answer);
    const std::vector<size_t> levels = levelsOf(part_, answer.condition);
    for (size_t factor = 0; factor < levels.size(); ++factor) {
      const std::string& name = part_.factors[factor].name;
      const auto own = answer.condition.find(name);
      if (own != answer.condition.end())
        count({1, {factor, levels[factor]}}, RateScope::Level, {{name, own->second}}, answer);
    }
    if (byStimulus_)
      count({1, {part_.factors.size(), answer.presentation == "static" ? 1U : 0U}}, RateScope::Level,
            {{"presentation", answer.presentation}}, answer);
    // False alarms that come with one state alone tell of answers by the first or last frame.
    if (byCatch_ && !answer.catchShows.empty())
      count({1, {part_.factors.size() + 1, answer.catchShows == "after" ? 1U : 0U}}, RateScope::Level,
            {{"catch_shows", answer.catchShows}}, answer);
    // With one factor its levels are the conditions.
    if (levels.size() > 1) count({2, levels}, RateScope::Condition, answer.condition, answer);
  }

  RateRow row(const Group& group, bool change, double level) const {
    RateRow out;
    out.part = part_.name;
    out.scope = group.scope;
    out.condition = group.condition;
    out.change = change;
    out.of = of();
    Count all;
    std::vector<double> rates;
    for (const auto& [observer, count] : group.observers) {
      all.positive += count.positive;
      all.trials += count.trials;
      rates.push_back(static_cast<double>(count.positive) / static_cast<double>(count.trials));
    }
    out.pooled = detectionRate(all.positive, all.trials, level);
    out.overObservers = meanRateOverSubjects(rates, level);
    if (out.scope == RateScope::Part) out.published = publishedRate(study_.plan.name, part_.name, change);
    out.text = group.condition.empty() ? "all" : conditionText(part_, group.condition);
    return out;
  }

  const StudyAnswers& study_;
  const StudyPart& part_;
  bool byStimulus_ = false, byCatch_ = false;
  std::map<GroupKey, Group> groups_[2];  // catch trials, trials with a change
};

}  // namespace

StudyRates studyRates(const StudyAnswers& study, double level) {
  StudyRates out;
  for (size_t part = 0; part < study.plan.parts.size(); ++part) {
    const StudyPart& plan = study.plan.parts[part];
    if (std::none_of(study.answers.begin(), study.answers.end(),
                     [&](const StudyAnswer& answer) { return answer.part == part; }))
      continue;
    if (!plan.isBinary()) {
      out.notes.push_back("part '" + plan.name + "' asks for more than one of two answers: no rates");
      continue;
    }
    if (plan.adaptive)
      out.notes.push_back("part '" + plan.name +
                          "': a procedure chose the stimuli, so that rates say more of it than of observers");
    const PartRates rates(study, part);
    rates.rows(level, out);
    rates.observers(level, out);
    addScenarioSpreads(study, part, out);
  }
  return out;
}

}  // namespace limen::analysis

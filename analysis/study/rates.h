// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/output/result.h"
#include "analysis/statistics/detection_rates.h"
#include "analysis/study/answers.h"
#include "analysis/study/published.h"

namespace limen::analysis {

/// What a rate is taken over.
enum class RateScope {
  Part,      ///< all answers of a part
  Level,     ///< one level of one factor, others together
  Condition  ///< one level of each factor
};

struct RateRow {
  std::string part;
  RateScope scope = RateScope::Part;
  std::map<std::string, std::string> condition;  ///< empty for a whole part
  bool change = true;                            ///< false: catch trials, a report being a false alarm
  std::string of;                                ///< "yes" or "right"
  Rate pooled;
  MeanOverSubjects overObservers;  ///< of each observer's own rate; the interval stays between 0 and 1
  /// Of rates with a change: Cousineau and Morey's, among the levels of a factor or all conditions, if all
  /// observers saw them all.
  std::optional<Interval> within;
  std::string text;  ///< the condition in words
  std::optional<PublishedRate> published;
};

struct ObserverRate {
  std::string part, observer, of;
  Rate change;
  std::optional<Rate> catches;
};

/// Mean and standard deviation of one value a scenario.
struct Spread {
  size_t scenarios = 0;
  double mean = 0.0;
  std::optional<double> sd;  ///< with n - 1; none for one scenario
  double sdOfN = 0.0;        ///< with n
};

/// How scenarios of one kind of stimulus differ: conditions, each with a change.
struct ScenarioSpread {
  std::string part, presentation;  ///< "static", "dynamic", or "all" if stimuli are of one kind
  std::string of;                  ///< "yes" or "right"
  Spread rate;                     ///< of each scenario's mean over observers of their own rates
  std::optional<Spread> severity;  ///< of each scenario's mean over answers that gave one
  std::optional<PublishedScenarios> published;
};

struct StudyRates {
  std::vector<RateRow> rows;  ///< by part: whole, levels, conditions; each with its catch trials
  std::vector<ObserverRate> observers;
  std::vector<ScenarioSpread> scenarios;
  std::vector<std::string> notes;  ///< parts that have no rates, and why
};

/// How often observers reported a change (or were right, with several alternatives), by condition and
/// observer. Schwarz 2009, section 10.4. Where a factor `presentation` is missing but stimuli are of both
/// kinds, it is taken from them.
StudyRates studyRates(const StudyAnswers& study, double level = 0.95);

/// Adds the scenarios of a part with binary answers.
void addScenarioSpreads(const StudyAnswers& study, size_t part, StudyRates& out);

/// A section for each part with tables "rates", "by_observer" and "over_scenarios".
Result resultOf(const StudyRates& rates);

}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/detection_rates.h"
#include "analysis/study/answers.h"

namespace limen::analysis {

/// What a rate is taken over.
enum class RateScope {
  Part,      ///< all answers of a part
  Level,     ///< one level of one factor, others together
  Condition  ///< one level of each factor
};

/// Mean and SD over observers that the thesis printed for a part.
struct PublishedRate {
  double mean = 0.0, sd = 0.0;
  const char* source = "";
};
std::optional<PublishedRate> publishedRate(const std::string& protocol, const std::string& part, bool change);

struct RateRow {
  std::string part;
  RateScope scope = RateScope::Part;
  std::map<std::string, std::string> condition;  ///< empty for a whole part
  bool change = true;                            ///< false: catch trials, a report being a false alarm
  std::string of;                                ///< "yes" or "right"
  Rate pooled;
  MeanOverSubjects overObservers;  ///< of each observer's own rate
  std::string text;                ///< the condition in words
  std::optional<PublishedRate> published;
};

struct ObserverRate {
  std::string part, observer, of;
  Rate change;
  std::optional<Rate> catches;
};

struct StudyRates {
  std::vector<RateRow> rows;  ///< by part: whole, levels, conditions; each with its catch trials
  std::vector<ObserverRate> observers;
  std::vector<std::string> notes;  ///< parts that have no rates, and why
};

/// How often observers reported a change (or were right, with several alternatives), by condition and
/// observer. Schwarz 2009, section 10.4. Where a factor `presentation` is missing but stimuli are of both
/// kinds, it is taken from them.
StudyRates studyRates(const StudyAnswers& study, double level = 0.95);

std::string toText(const StudyRates& rates);
nlohmann::json toJson(const StudyRates& rates);
std::string toCsv(const StudyRates& rates);

}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/repeated_measures_anova.h"
#include "analysis/study/answers.h"
#include "analysis/study/published.h"

namespace limen::analysis {

/// Analysis of variance of one part: each observer's rate of reports (or of right answers) in each condition,
/// of trials with a change.
struct PartAnova {
  std::string part, of;                 ///< of: "yes" or "right"
  std::vector<StudyFactor> factors;     ///< within observers; those of one level are left out
  std::vector<std::string> incomplete;  ///< observers without an answer in some condition: left out here
  bool unequalReplicates = false;
  std::optional<RepeatedMeasuresAnova> result;
  std::vector<std::optional<PublishedEffect>> published;  ///< for each effect
  std::string note;                                       ///< why there is no result
};

/// All parts with answers. Schwarz 2009, sections 10.4.1 and 10.4.2: each effect against its own interaction
/// with observers. The published values are those of the protocols experiment_1 and experiment_2.
std::vector<PartAnova> studyAnova(const StudyAnswers& study);

std::string toText(const std::vector<PartAnova>& parts);
nlohmann::json toJson(const std::vector<PartAnova>& parts);
std::string toCsv(const std::vector<PartAnova>& parts);

}  // namespace limen::analysis

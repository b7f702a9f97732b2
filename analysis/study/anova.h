// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/repeated_measures_anova.h"
#include "analysis/study/answers.h"

namespace limen::analysis {

/// What a study printed for an effect, to be set beside one's own.
struct PublishedEffect {
  double f = 0.0, df = 0.0, dfError = 0.0;
  std::string p;          ///< as printed
  bool fDerived = false;  ///< F was not printed and is the one that p belongs to
  std::string remark;
  std::string source;
};

/// Levels of one factor, other factors averaged.
struct FactorComparison {
  std::vector<PairedComparison> pairs;
};

/// Analysis of variance of one part: each observer's rate of reports (or of right answers) in each condition,
/// of trials with a change.
struct PartAnova {
  std::string part, of;                 ///< of: "yes" or "right"
  std::vector<StudyFactor> factors;     ///< within observers; those of one level are left out
  std::vector<std::string> incomplete;  ///< observers without an answer in some condition: left out here
  bool unequalReplicates = false;
  std::optional<RepeatedMeasuresAnova> result;
  std::vector<std::optional<PublishedEffect>> published;  ///< for each effect
  std::vector<FactorComparison> comparisons;              ///< for each of `factors`
  std::string note;                                       ///< why there is no result
};

/// All parts with answers. Schwarz 2009, sections 10.4.1 and 10.4.2: each effect against its own interaction
/// with observers. The published values are those of the protocols experiment_1 and experiment_2.
std::vector<PartAnova> studyAnova(const StudyAnswers& study);

/// Effect of a protocol's part as the thesis printed it, by the names of the factors that take part.
std::optional<PublishedEffect> publishedEffect(const std::string& protocol, const std::string& part,
                                               const std::vector<std::string>& factors);

std::string toText(const std::vector<PartAnova>& parts);
nlohmann::json toJson(const std::vector<PartAnova>& parts);
std::string toCsv(const std::vector<PartAnova>& parts);

}  // namespace limen::analysis

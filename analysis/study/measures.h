// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "analysis/correlations/correlations.h"
#include "analysis/study/answers.h"
#include "analysis/study/predicted.h"

namespace limen::analysis {

/// What was measured under one condition of a part, trials with a change only.
struct ConditionMeasures {
  std::vector<size_t> levels;  ///< of levelsOf(), the factor `presentation` apart
  std::string presentation;
  /// detection_rate, share_right or mean_rating (mean over observers of their own), mean_severity (of those
  /// who said yes), median_reaction_time_s (over answers).
  std::map<std::string, double> measures;
  std::map<std::string, double> predictors;  ///< means over the answers' stimuli
};

/// Conditions of a part in the order of its factors. `values` may be empty; `displays` leads from a display
/// that was used to the one that was predicted for.
std::vector<ConditionMeasures> measureConditions(const StudyAnswers& study, size_t part,
                                                 const ChosenPredictions& predictions,
                                                 const std::map<std::string, std::string>& displays);

/// How the measures of a study go together over the conditions of each part: each with each other, those at
/// rest with those in motion, and each predictor (studyPredictors()) with how often changes were noticed.
/// validateStudy() looks at predictors in detail. Predictors are left out, with a note, where a stimulus has
/// no prediction. Throws Error if nothing can be set against anything.
Correlations correlateMeasures(const StudyAnswers& study,
                               const std::vector<store::StudyPrediction>& predictions,
                               const std::map<std::string, std::string>& displayNames,
                               const CorrelationSetting& setting);

}  // namespace limen::analysis

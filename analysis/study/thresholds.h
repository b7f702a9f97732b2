// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/observer_statistics/anova.h"
#include "analysis/output/result.h"
#include "analysis/psychometric/intervals.h"
#include "analysis/study/answers.h"
#include "analysis/study/fitted_parts.h"
#include "analysis/study/procedure_estimates.h"

namespace limen::analysis {

/// An observer's threshold in one condition.
struct ObserverThreshold {
  size_t observer = 0;   ///< index of StudyAnswers::observers
  size_t condition = 0;  ///< index of PartThresholds::conditions
  int64_t trials = 0;
  std::optional<double> value;          ///< none where the answers set none
  std::optional<FitInterval> interval;  ///< profile likelihood
  std::optional<ProcedureEstimate> procedure;
  std::string note;  ///< why there is no value
};

/// A condition over observers. On a logarithmic axis means are geometric, and all is of ln thresholds.
struct ThresholdCondition {
  std::map<std::string, std::string> levels;
  std::string name;  ///< "lod_change=fine, presentation=static"; "all" without factors
  size_t observers = 0;
  std::optional<double> mean;
  std::optional<Interval> interval;  ///< Student's t over observers
  std::optional<Interval> within;    ///< Cousineau and Morey's, of observers with all conditions
  std::optional<double> sd;          ///< of ln thresholds on a logarithmic axis
};

/// Thresholds of a part, or why there are none.
struct PartThresholds {
  std::string part, variable;
  std::string title;      ///< of the variable with its unit
  std::string procedure;  ///< type; "" if stimuli were constant
  FitSettings settings;   ///< of the fits; how parameters are shared goes by an observer's conditions
  std::vector<std::string> factors;  ///< that make conditions
  std::vector<ThresholdCondition> conditions;
  std::vector<ObserverThreshold> observers;  ///< by observer, then by condition
  std::optional<PartAnova> anova;  ///< of thresholds, or of their logarithms; none with one condition
  std::string note;

  bool logarithmic() const { return settings.logarithmic(); }
};

/// Thresholds of each observer in each condition, and what conditions do to them. A psychometric function is
/// fitted to each observer's own answers by maximum likelihood: conditions have thresholds of their own and
/// share one width, one lapse rate and, in yes/no tasks, one guess rate, catch trials included. A threshold
/// at a bound of the fit is none. Means and tests are over observers: observers differ, which intervals of
/// pooled answers leave out.
///
/// `part` "": parts whose stimuli a procedure chose; if none is, all with a numeric variable. Throws Error as
/// fittedParts() for a part that is named and has no thresholds, and if no part has any.
std::vector<PartThresholds> studyThresholds(const StudyAnswers& study, const std::string& part = {},
                                            const AnovaSettings& settings = {});

/// Those of the parts whose stimuli a procedure chose; may be empty.
std::vector<PartThresholds> adaptiveThresholds(const StudyAnswers& study);

/// Tables "conditions", "thresholds" (of each observer, a column a factor), "effects", "pairs".
Section sectionOf(const PartThresholds& part, const StudyAnswers& study);
Result resultOf(const std::vector<PartThresholds>& parts, const StudyAnswers& study);

}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/psychometric/fit_settings.h"
#include "analysis/study/answers.h"

namespace limen::analysis {

/// What psychometric functions are fitted to.
struct FittedPartsChoice {
  std::string part;      ///< "": all that have a function to be fitted
  std::string variable;  ///< "": as fittedParts() finds it
  /// Factors and "observer" whose values make conditions; all factors but the variable unless set.
  std::optional<std::vector<std::string>> by;
  bool guessFromCatch = false;  ///< yes/no: the rate in catch trials is held, not fitted with the rest
};

/// Answers of one part as blocks of one numeric stimulus variable.
struct FittedPart {
  size_t part = 0;  ///< index of StudyPlan::parts
  std::string variable;
  FitTask task;
  std::vector<Condition> conditions;  ///< in the protocol's order of levels, observers in that of sessions
  std::vector<std::map<std::string, std::string>> levels;  ///< of each condition's factors
  std::optional<double> guess;                             ///< of catch trials, where asked for
  size_t pooledObservers = 0;      ///< whose answers a condition may mix; 0: not mixed
  FittedPartsChoice choice;        ///< that it was made by
  std::vector<std::string> notes;  ///< what whoever reads a fit has to know of the answers
};

/// Numeric variables of a part: axes of its procedure, and factors all of whose levels are numbers.
std::vector<std::string> numericVariables(const StudyPart& part);

/// Each part of a study with yes/no, interval or alternative tasks and a numeric variable: the values that
/// its procedure asked for, or a factor all of whose levels are numbers. Unless named, the variable is the
/// procedure's only axis, that of the protocol's `simulation:` block, or the only such factor. Answers to one
/// level in one condition make a block, those of catch trials one at kNoStimulus.
///
/// Throws Error: no such part, variable or factor, a part that cannot be fitted if it was named, or none that
/// can; with what there is to choose from.
std::vector<FittedPart> fittedParts(const StudyAnswers& study, const FittedPartsChoice& choice);

/// Settings for fits to single observers: task of the part; sigmoid, axis, direction and threshold level as
/// the protocol assumes them, or the direction in which the answers in `fitted` go.
FitSettings ownFitSettings(const StudyPart& part, const FittedPart& fitted);
/// One width, one lapse rate and, in yes/no tasks, one guess rate for all of an observer's conditions, unless
/// they are fixed.
void shareAllButThreshold(FitSettings& settings, size_t conditions);

}  // namespace limen::analysis

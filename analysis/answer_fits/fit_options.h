// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/answer_fits/fit_answer.h"

namespace limen::analysis {

enum class Resampling {
  Parametric,    ///< answers drawn from the fit
  Nonparametric  ///< from the answers themselves
};
constexpr EnumNames<Resampling, 2> enumNames(Resampling) {
  return {{{{Resampling::Parametric, "parametric"}, {Resampling::Nonparametric, "nonparametric"}}}};
}

/// What a user asks of `limen analyse fit`. Empty: the default, or of a study what its protocol says.
struct FitOptions {
  std::string file;
  std::string level, correct, trials, outcome, order;  ///< names of columns
  std::vector<std::string> by;                         ///< columns whose values make conditions
  std::string sigmoid, axis, direction;                ///< normal, linear, rising unless set
  std::optional<double> thresholdLevel;                ///< 0.5 unless set
  std::vector<double> range;
  FitSettings settings;  ///< the rest
  std::optional<IntervalMethod> intervals;
  Resampling resampling = Resampling::Parametric;
  double confidence = 0.95;
  bool goodness = false;
  size_t samples = 2000;
  uint64_t seed = 1;
  unsigned threads = 2;
};
/// Holds a parameter at a value: "lapse=0.01". Throws Error.
void fixParameter(FitSettings& settings, const std::string& text);
/// Lets all conditions have a parameter in common, by its name. Throws Error.
void shareParameter(FitSettings& settings, const std::string& name);

/// `data`: what direction "auto" is told from. Throws Error.
FitSettings readFitSettings(const FitOptions& options, const std::vector<Condition>& data);
/// Blocks of each condition, conditions in the order in which the file names them. Rows of single trials
/// (outcome 0 or 1) at one level make one block. Throws Error with row and column.
std::vector<Condition> readConditions(const FitOptions& options);
/// Fits `data`, which was read from options.file; throws Error.
FitAnswer answerFit(const FitOptions& options, std::vector<Condition> data);

}  // namespace limen::analysis

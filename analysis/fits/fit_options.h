// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analysis/fits/fit_answer.h"

namespace limen::analysis {

/// What a user asks of `limen analyse fit`, as typed.
struct FitOptions {
  std::string file;
  std::string level, correct, trials, outcome, order;  ///< names of columns
  std::vector<std::string> by;                         ///< columns whose values make conditions
  std::string task = "2afc", sigmoid = "normal", method = "ml", axis = "linear", intervals;
  std::string resample = "parametric";
  std::vector<std::string> fixed, shared;  ///< "lapse=0.01"; "lapse"
  std::vector<double> range;
  double thresholdLevel = 0.5, confidence = 0.95, lapseMost = 0.1, guessMost = 0.5;
  bool overdispersion = false, goodness = false;
  int64_t samples = 2000;
  uint64_t seed = 1;
  unsigned threads = 2;
};

FitSettings readFitSettings(const FitOptions& options);  ///< throws Error
/// Blocks of each condition, conditions in the order in which the file names them. Rows of single trials
/// (outcome 0 or 1) at one level make one block. Throws Error with row and column.
std::vector<Condition> readConditions(const FitOptions& options);
FitAnswer answerFit(const FitOptions& options);  ///< throws Error

}  // namespace limen::analysis

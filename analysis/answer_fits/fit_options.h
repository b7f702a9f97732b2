// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/answer_fits/fit_answer.h"

namespace limen::analysis {

/// What a user asks of `limen analyse fit`, as typed. Empty: the default.
struct FitOptions {
  std::string file;
  std::string level, correct, trials, outcome, order;  ///< names of columns
  std::vector<std::string> by;                         ///< columns whose values make conditions
  std::string task, sigmoid, axis, direction;          ///< 2afc, normal, linear, rising unless set
  std::string method = "ml", intervals;
  std::string resample = "parametric";
  std::vector<std::string> fixed, shared;  ///< "lapse=0.01"; "lapse"
  std::vector<double> range;
  std::optional<double> thresholdLevel;  ///< 0.5 unless set
  double confidence = 0.95, lapseMost = 0.1, guessMost = 0.5;
  bool overdispersion = false, goodness = false;
  int64_t samples = 2000;
  uint64_t seed = 1;
  unsigned threads = 2;
};

/// `data`: what direction "auto" is told from. Throws Error.
FitSettings readFitSettings(const FitOptions& options, const std::vector<Condition>& data);
/// Blocks of each condition, conditions in the order in which the file names them. Rows of single trials
/// (outcome 0 or 1) at one level make one block. Throws Error with row and column.
std::vector<Condition> readConditions(const FitOptions& options);
/// Fits `data`, which was read from options.file; throws Error.
FitAnswer answerFit(const FitOptions& options, std::vector<Condition> data);

}  // namespace limen::analysis

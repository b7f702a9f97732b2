// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/interval.h"

namespace limen::analysis {

enum class RandomEffects {
  kIntercept,         ///< each group has its own level
  kInterceptAndSlope  ///< and its own slope along one column, correlated with the level
};

/// Binomial answers of groups, such as subjects: ln(p / (1 - p)) = x beta + b_g (+ c_g x_slope), (b, c) ~
/// N(0, Sigma).
struct MixedLogisticData {
  std::vector<int64_t> successes, trials;  ///< one entry per row; a single answer has one trial
  std::vector<size_t> groups;              ///< of each row; any numbers
  std::vector<std::string> columns;        ///< names of the fixed effects; the intercept is a column of ones
  std::vector<double> design;              ///< rows x columns, by row
};

struct MixedLogisticOptions {
  RandomEffects random = RandomEffects::kIntercept;
  size_t slopeColumn = 1;  ///< of kInterceptAndSlope
  double level = 0.95;
};

struct FixedEffect {
  std::string name;
  double estimate = 0.0, standardError = 0.0;
  double z = 0.0, p = 1.0;  ///< Wald, two-sided
  Interval interval;        ///< estimate +- z error
};

struct GroupEffect {
  size_t group = 0;
  double intercept = 0.0, slope = 0.0;  ///< conditional modes, deviations from the fixed effects
};

struct MixedLogistic {
  std::vector<FixedEffect> fixed;
  double interceptDeviation = 0.0;  ///< of b over groups
  /// With a random slope; no correlation if a deviation is 0.
  std::optional<double> slopeDeviation, correlation;
  double logLikelihood = 0.0;       ///< Laplace's approximation, binomial coefficients included
  double aic = 0.0;                 ///< 2 (fixed effects + entries of Sigma) - 2 logLikelihood
  std::vector<GroupEffect> groups;  ///< by ascending group
  /// Sigma is on the boundary (a deviation of 0, a correlation of +-1): errors treat boundary parameters as
  /// fixed.
  bool singular = false;
  std::string note;  ///< a message to that effect; empty otherwise
};

/// Maximum of the likelihood by Laplace's approximation (Breslow and Clayton 1993; Bates, Maechler, Bolker
/// and Walker 2015): penalised Newton steps within each group, BFGS with exact derivatives outside. Errors
/// from the Hessian over fixed effects and Sigma. The approximation is poor, Sigma too small, with few yes/no
/// answers per group. limen::Error (names the index) for mismatched lengths, non-finite values, inconsistent
/// counts; for fewer than 2 groups, columns that depend on one another, answers that some combination of
/// columns separates (estimates would be infinite), and if the optimiser finds no maximum.
MixedLogistic fitMixedLogistic(const MixedLogisticData& data, const MixedLogisticOptions& options = {});

}  // namespace limen::analysis

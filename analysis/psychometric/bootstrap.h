// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <functional>

#include "analysis/psychometric/fit.h"

namespace limen::psychometrics {
class Random;
}

namespace limen::analysis {

/// Successes in n trials by inversion starting at the most likely number: exact, in about sqrt(n) steps with
/// one random number. `q` is 1 - p.
int64_t drawBinomial(psychometrics::Random& random, int64_t n, double p, double q);

/// The quantities that get intervals: the parameters and the slope.
inline constexpr size_t kFitQuantities = kFitParameters + 1;
using FitQuantities = std::array<double, kFitQuantities>;
FitQuantities quantitiesOf(const ConditionFit& fit);

/// Deviance residuals of a condition's blocks with trials, sqrt of each block's deviance with the sign of
/// k/n - P, and their correlations (Pearson) with the predicted P and with the blocks' order; 0 if either
/// does not vary. (Wichmann and Hill 2001, Perception and Psychophysics 63, 1293-1313.)
struct Residuals {
  std::vector<double> levels, predicted, values;
  double withPrediction = 0.0, withOrder = 0.0;
};
Residuals residualsOf(const Condition& condition, const ConditionFit& fit, const FitSettings& settings);

struct BootstrapOptions {
  size_t samples = 2000;
  uint64_t seed = 1;
  /// Answers drawn from the fitted function (beta-binomial if eta > 0); otherwise each block's trials are
  /// resampled from its own answers.
  bool parametric = true;
  unsigned threads = 2;  ///< affects only the run time
};

/// One data set drawn and fitted like the data.
struct Replicate {
  bool fitted = false;  ///< false if a fixed function cannot have produced the answers
  struct OfCondition {
    FitQuantities quantities{};
    double deviance = 0.0, withPrediction = 0.0, withOrder = 0.0;
  };
  std::vector<OfCondition> conditions;
};

/// Calls work(0) ... work(count - 1), each once, in so many threads; rethrows what one of them throws.
void inThreads(size_t count, unsigned threads, const std::function<void(size_t)>& work);

/// Replicate i takes its numbers from childSeed(seed, "replicate i").
std::vector<Replicate> bootstrap(const std::vector<Condition>& conditions, const Fit& fit,
                                 const BootstrapOptions& options);

/// Quantity of a condition in every fitted replicate, ascending.
std::vector<double> sortedQuantity(const std::vector<Replicate>& replicates, size_t condition,
                                   size_t quantity);

}  // namespace limen::analysis

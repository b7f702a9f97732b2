// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analysis/psychometric/bootstrap.h"
#include "analysis/psychometric/fit.h"
#include "analysis/statistics/interval.h"
#include "experiments/base/enum_names.h"

namespace limen::analysis {

enum class IntervalMethod {
  Bootstrap,  ///< percentiles of the replicates
  Bca,        ///< bias-corrected and accelerated percentiles (Efron 1987, JASA 82)
  Profile,    ///< where the maximum over all others has dropped by half the chi-squared quantile
  Laplace,    ///< normal by the curvature at the optimum, on the scales of t, ln w and the rates
  Posterior,  ///< equal-tailed, of the marginals of a grid posterior with the priors of prior.h
  Observers,  ///< jackknife over the observers whose answers were pooled (analysis/study)
  None        ///< asked for none
};
constexpr EnumNames<IntervalMethod, 7> enumNames(IntervalMethod) {
  return {{{{IntervalMethod::Bootstrap, "bootstrap"},
            {IntervalMethod::Bca, "bca"},
            {IntervalMethod::Profile, "profile"},
            {IntervalMethod::Laplace, "laplace"},
            {IntervalMethod::Posterior, "posterior"},
            {IntervalMethod::Observers, "observers"},
            {IntervalMethod::None, "none"}}}};
}

struct FitInterval : Interval {
  bool lowOpen = false, highOpen = false;  ///< ends at a bound of the fit: the data set no limit on that side
};

/// For each parameter and the slope; none for fixed ones, and if a method gives none: a parameter at its
/// bound (Laplace), the slope on a logarithmic axis (profile, posterior).
using ConditionIntervals = std::array<std::optional<FitInterval>, kFitQuantities>;

struct FitIntervals {
  IntervalMethod method = IntervalMethod::Bootstrap;
  double confidence = 0.95;
  std::vector<ConditionIntervals> conditions;
  std::vector<std::string> warnings;
};

/// On a linear axis the slope is a constant over the width, and so is its interval; none on a logarithmic
/// one.
std::optional<FitInterval> slopeOfWidth(const ConditionFit& fit, const FitSettings& settings,
                                        const ConditionIntervals& intervals);

/// From replicates of bootstrap(). Bca needs two further fits per block for the acceleration: the change of
/// the estimates with one answer less (jackknife over trials).
FitIntervals bootstrapIntervals(const std::vector<Condition>& conditions, const Fit& fit,
                                const std::vector<Replicate>& replicates, bool accelerated,
                                double confidence);
FitIntervals profileIntervals(const std::vector<Condition>& conditions, const Fit& fit, double confidence);
FitIntervals laplaceIntervals(const std::vector<Condition>& conditions, const Fit& fit, double confidence);
/// Throws Error if conditions share parameters: the grid would have too many dimensions.
FitIntervals posteriorIntervals(const std::vector<Condition>& conditions, const Fit& fit, double confidence);

/// What is known of how often 95 % intervals of a method held the true value in simulated experiments, for
/// those where that was outside of 93 to 97 %; empty where it was not. Of experiments with the same task, or
/// with two alternatives where that was not simulated. The table in coverage.cpp says what was.
std::vector<std::string> coverageNotes(IntervalMethod method, bool parametric, const FitTask& task);

}  // namespace limen::analysis

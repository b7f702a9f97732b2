// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "analysis/psychometric/fit_settings.h"

namespace limen::analysis {

/// Parameters of one condition in the order of FitParameter. The threshold is on the axis: ln x if that is
/// logarithmic.
using AxisValues = std::array<double, kFitParameters>;

/// The parts of a sigmoid that do not change during a fit.
struct SigmoidShape {
  explicit SigmoidShape(const FitSettings& settings);

  psychometrics::SigmoidFamily family;
  bool logarithmic, falling;
  double level;         ///< F at the threshold
  double zAtThreshold;  ///< standard form's argument there
  double zWidth;        ///< from F = 0.05 to 0.95

  /// u = x or ln x, negated if F falls, so that F always rises with u; -infinity if there is no stimulus.
  double onAxis(double x) const;
  double offAxis(double u) const;
  /// The same for both ends of an interval, which a falling F turns round.
  std::array<double, 2> offAxis(double low, double high) const;
  double z(double u, const AxisValues& values) const;
};

/// P, 1 - P and their logarithms at one level, without cancellation in either tail.
struct Chance {
  double p, q, logP, logQ;
};
Chance chanceAt(const SigmoidShape& shape, double u, const AxisValues& values);
inline double rho(double eta) { return eta * eta / (1.0 - eta * eta); }

/// A condition's blocks, preprocessed: levels on the axis, constants of the likelihood.
struct PreparedBlocks {
  PreparedBlocks(const Condition& condition, const SigmoidShape& shape);

  std::vector<double> u;  ///< of each block with trials
  std::vector<int64_t> correct, trials;
  std::vector<double> order;
  double logSaturated = 0.0;  ///< binomial log-likelihood if every P is k/n
};

/// Sum over trials of (u - mean u)(answer - mean answer); excluding blocks without a stimulus.
double covariance(const PreparedBlocks& blocks);

/// Half the binomial deviance of one block.
double halfBlockDeviance(const Chance& chance, int64_t correct, int64_t trials);

/// logSaturated minus the log-likelihood of `values`: half the deviance for a binomial (eta 0). Infinite if
/// the data are impossible. With `gradient`, its derivatives are added there, in the order of FitParameter.
double negativeLogLikelihood(const SigmoidShape& shape, const PreparedBlocks& blocks,
                             const AxisValues& values, AxisValues* gradient);

}  // namespace limen::analysis

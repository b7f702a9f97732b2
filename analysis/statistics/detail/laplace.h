// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

namespace limen::analysis {

/// Logistic model with normal random effects b = L u, u ~ N(0, I), L lower triangular; one or two effects per
/// group.
struct LaplaceModel {
  Eigen::MatrixXd fixed;                          ///< rows x coefficients
  Eigen::MatrixXd random;                         ///< rows x effects
  Eigen::VectorXd successes, trials;              ///< of each row
  std::vector<std::vector<Eigen::Index>> groups;  ///< rows of each

  /// Coefficients, then the entries of L by row.
  Eigen::Index parameters() const { return fixed.cols() + random.cols() * (random.cols() + 1) / 2; }
  Eigen::MatrixXd factor(const Eigen::VectorXd& parameters) const;
};

struct LaplaceValue {
  double logLikelihood = 0.0;
  Eigen::VectorXd gradient;
  std::vector<Eigen::VectorXd> modes;  ///< u of each group
  bool settled = true;                 ///< the modes were found
};

/// ln of the probability of `successes` of `trials` at log odds `eta`, including the binomial coefficient.
double binomialLogChance(double successes, double trials, double eta);

/// Laplace's approximation of the log-likelihood with its exact gradient; the modes move with the parameters.
LaplaceValue evaluateLaplace(const LaplaceModel& model, const Eigen::VectorXd& parameters);

}  // namespace limen::analysis

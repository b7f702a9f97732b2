// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/psychometric/fit_settings.h"

namespace limen::analysis {

/// One condition's psychometric function P(x) = guess + (1 - guess - lapse) F(x) as fitted.
struct ConditionFit {
  std::string name;
  std::array<double, kFitParameters> values{};  ///< in the order of FitParameter; threshold in units of x
  std::array<bool, kFitParameters> fitted{};    ///< varied by the fit, alone or together with others
  std::array<int, kFitParameters> atBound{};    ///< -1 at the lower bound of the fit, 1 at the upper
  double slope = 0.0;                           ///< dF/dx at the threshold; negative if F falls
  double deviance = 0.0;       ///< binomial: twice the log-likelihood difference to P = k/n in every block
  double logLikelihood = 0.0;  ///< including binomial coefficients; beta-binomial if eta > 0
  double logPrior = 0.0;       ///< of its priors, shared ones too; 0 for MaximumLikelihood
  int64_t trials = 0;
  size_t blocks = 0;                  ///< those with trials
  std::vector<std::string> warnings;  ///< what readers of the numbers have to know

  /// "NAME: ", before a warning; "" for one without a name.
  std::string prefix() const { return name.empty() ? "" : name + ": "; }
  double value(FitParameter parameter) const { return values[indexOf(parameter)]; }
  /// F; of -x or 1/x if it falls with x.
  psychometrics::Sigmoid sigmoid(const FitSettings& settings) const;
  double probability(const FitSettings& settings, double x) const;  ///< P; the guess rate at kNoStimulus
};

struct Fit {
  FitSettings settings;
  std::vector<ConditionFit> conditions;
  std::vector<double> x;  ///< what was varied, on the axis; widths as logarithms
  double deviance = 0.0, logLikelihood = 0.0;
  double logPrior = 0.0;  ///< ln of the priors' density, up to a constant; 0 for MaximumLikelihood
  size_t freeParameters = 0;
  double aic = 0.0, bic = 0.0;  ///< by the log-likelihood; BIC counts trials

  double logPosterior() const { return logLikelihood + logPrior; }
};

/// The optimum within the bounds: grid, several starts,
/// BFGS, Newton. Throws Error like checkFit().
Fit fitPsychometric(const std::vector<Condition>& conditions, const FitSettings& settings,
                    const std::string& where = {});

/// Likelihood-ratio test of `restricted` within `full`: both fitted by maximum likelihood to the same data,
/// `restricted` with fewer parameters. Chi-squared holds for many trials and parameters inside their bounds.
struct LikelihoodRatio {
  double statistic = 0.0;
  size_t degrees = 0;
  double p = 1.0;
};
LikelihoodRatio likelihoodRatio(const Fit& restricted, const Fit& full);

/// Names and versions of the libraries that fit.
std::vector<std::array<std::string, 2>> fitLibraries();

}  // namespace limen::analysis

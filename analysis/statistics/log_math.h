// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace limen::analysis {

// Logarithms of probabilities, accurate to 1e-12 relative wherever the result is not 0, for counts to 1e6 and
// beyond.

double logAddExp(double a, double b);  ///< ln(exp(a) + exp(b)); either may be -infinity

/// x ln(x/m) + m - x >= 0, half the deviance of a count x with mean m; without cancellation if x is near m
/// (Loader 2000, Fast and accurate computation of binomial probabilities). `logM` is ln m, which may be known
/// even if m has underflowed to 0.
double halfDeviance(double x, double m, double logM);

/// ln n! - ln of Stirling's formula sqrt(2 pi n) (n/e)^n, n >= 0.
double stirlingError(double n);

/// ln of the probability of k of n at probability k/n: the largest log-likelihood that a block can have.
double logSaturatedChance(int64_t k, int64_t n);

/// The number of successes in n trials up to which chances sum to `u`, 0 <= u < 1, taken from the most likely
/// number outwards: with a random `u` a binomial number, exact, in about sqrt(n) steps. `q` is 1 - p.
int64_t binomialAt(double u, int64_t n, double p, double q);

/// Sum over i < k of ln(p + i r), and its derivatives by p and r: the equivalent of the Gamma functions of a
/// beta-binomial with mean p and overdispersion r. Time does not grow with k.
struct RisingSum {
  double value = 0.0, byP = 0.0, byR = 0.0;
};
RisingSum logRisingSum(double p, double r, int64_t k);

}  // namespace limen::analysis

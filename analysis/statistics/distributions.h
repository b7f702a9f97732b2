// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace limen::analysis {

/// Distributions used by tests and intervals, from Boost.Math in extended precision, so that far tails keep a
/// relative error below 1e-12 down to the smallest normal number. Lower and upper tails are separate
/// functions: 1 - lower would lose the upper tail. Arguments out of range are a programmer's error, asserted
/// here; the statistics check what users give.

double normalDensity(double z);
double normalLower(double z);  ///< P(Z <= z)
double normalUpper(double z);  ///< P(Z >= z)
/// ln P(Z <= z), without underflow for any finite z.
double logNormalLower(double z);
/// z of the lower tail p; -infinity and +infinity for 0 and 1.
double normalQuantile(double p);
/// z within which a standard normal number lies with the probability `level`.
double criticalZ(double level);
double normalTwoSided(double z);  ///< P(|Z| >= |z|)

double tTwoSided(double t, double degrees);  ///< P(|T| >= |t|), Student's t
/// t with a two-sided tail of `p` in (0, 1).
double tCritical(double p, double degrees);

double fUpper(double f, double degrees1, double degrees2);  ///< P(F >= f); 0 for infinite f
double chiSquaredUpper(double x, double degrees);           ///< P(X >= x); 0 for infinite x

double betaQuantile(double p, double a, double b);  ///< lower tail p

/// Noncentrality with which F of these degrees is at most `f` with probability `p`, 0 if even the central F
/// falls short of `p`. Throws std::runtime_error if its series is out of reach: degrees1 f > 1e8.
double noncentralityOfF(double f, double degrees1, double degrees2, double p);

}  // namespace limen::analysis

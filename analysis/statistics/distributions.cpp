// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/distributions.h"

#include <boost/math/distributions/non_central_f.hpp>
#include <boost/math/special_functions/beta.hpp>
#include <boost/math/special_functions/erf.hpp>
#include <boost/math/special_functions/gamma.hpp>
#include <boost/math/tools/roots.hpp>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace limen::analysis {
namespace {

// Underflow is an answer here: such a tail is 0.
using Policy = boost::math::policies::policy<
    boost::math::policies::overflow_error<boost::math::policies::ignore_error>,
    boost::math::policies::underflow_error<boost::math::policies::ignore_error>>;
constexpr Policy kPolicy;
constexpr long double kRootHalf = 0.5L * std::numbers::sqrt2_v<long double>;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

double upper(long double z) { return static_cast<double>(0.5L * std::erfc(z * kRootHalf)); }

}  // namespace

double normalDensity(double z) {
  const auto x = static_cast<long double>(z);
  return static_cast<double>(std::exp(-0.5L * x * x) / std::sqrt(2.0L * std::numbers::pi_v<long double>));
}

double normalLower(double z) { return upper(-static_cast<long double>(z)); }
double normalUpper(double z) { return upper(z); }
double normalTwoSided(double z) {
  return static_cast<double>(std::erfc(std::abs(static_cast<long double>(z)) * kRootHalf));
}

double logNormalLower(double z) {
  const auto x = static_cast<long double>(z);
  if (z > 0.0) return static_cast<double>(std::log1p(-0.5L * std::erfc(x * kRootHalf)));
  if (z > -100.0) return static_cast<double>(std::log(0.5L * std::erfc(-x * kRootHalf)));
  // Asymptotic series of Mills' ratio; its fourth term is below 1e-13 here.
  const long double s = 1.0L / (x * x);
  return static_cast<double>(-0.5L * x * x - std::log(-x) -
                             0.5L * std::log(2.0L * std::numbers::pi_v<long double>) +
                             std::log1p(-s * (1.0L - 3.0L * s * (1.0L - 5.0L * s))));
}

double normalQuantile(double p) {
  assert(p >= 0.0 && p <= 1.0);
  if (p == 0.0) return -kInfinity;
  if (p == 1.0) return kInfinity;
  return static_cast<double>(-std::numbers::sqrt2_v<long double> *
                             boost::math::erfc_inv(2.0L * static_cast<long double>(p), kPolicy));
}

double criticalZ(double level) { return -normalQuantile((1.0 - level) / 2.0); }

double tTwoSided(double t, double degrees) {
  assert(degrees > 0.0 && !std::isnan(t));
  if (std::isinf(t)) return 0.0;
  const long double v = degrees, t2 = static_cast<long double>(t) * t;
  // Whichever argument is the smaller keeps its digits.
  const long double p = t2 > v ? boost::math::ibeta(v / 2.0L, 0.5L, v / (v + t2), kPolicy)
                               : boost::math::ibetac(0.5L, v / 2.0L, t2 / (v + t2), kPolicy);
  return static_cast<double>(p);
}

double tCritical(double p, double degrees) {
  assert(p > 0.0 && p < 1.0 && degrees > 0.0);
  long double complement = 0.0L;
  const long double x = boost::math::ibeta_inv(static_cast<long double>(degrees) / 2.0L, 0.5L,
                                               static_cast<long double>(p), &complement, kPolicy);
  return static_cast<double>(std::sqrt(degrees * complement / x));
}

double fUpper(double f, double degrees1, double degrees2) {
  assert(f >= 0.0 && degrees1 > 0.0 && degrees2 > 0.0);
  if (std::isinf(f)) return 0.0;
  const long double a = degrees1 / 2.0L, b = degrees2 / 2.0L;
  const long double weighted = static_cast<long double>(degrees1) * f, sum = weighted + degrees2;
  const long double p = weighted > degrees2 ? boost::math::ibeta(b, a, degrees2 / sum, kPolicy)
                                            : boost::math::ibetac(a, b, weighted / sum, kPolicy);
  return static_cast<double>(p);
}

double chiSquaredUpper(double x, double degrees) {
  assert(x >= 0.0 && degrees > 0.0);
  if (std::isinf(x)) return 0.0;
  return static_cast<double>(boost::math::gamma_q(static_cast<long double>(degrees) / 2.0L,
                                                  static_cast<long double>(x) / 2.0L, kPolicy));
}

double betaQuantile(double p, double a, double b) {
  assert(p >= 0.0 && p <= 1.0 && a > 0.0 && b > 0.0);
  return static_cast<double>(boost::math::ibeta_inv(static_cast<long double>(a), static_cast<long double>(b),
                                                    static_cast<long double>(p), kPolicy));
}

double noncentralityOfF(double f, double degrees1, double degrees2, double p) {
  assert(f >= 0.0 && p > 0.0 && p < 1.0);
  if (degrees1 * f > 1e8) throw std::runtime_error("noncentral F of too large a value");
  const auto excess = [&](double noncentrality) {
    if (noncentrality == 0.0) return 1.0 - fUpper(f, degrees1, degrees2) - p;
    return boost::math::cdf(
               boost::math::non_central_f_distribution<double>(degrees1, degrees2, noncentrality), f) -
           p;
  };
  const double atZero = excess(0.0);
  if (atZero <= 0.0) return 0.0;
  double low = 0.0, high = std::max(1.0, degrees1 * f), atLow = atZero, atHigh = excess(high);
  while (atHigh > 0.0) {
    low = high;
    atLow = atHigh;
    high *= 2.0;
    atHigh = excess(high);
  }
  if (atHigh == 0.0) return high;
  std::uintmax_t steps = 200;
  const auto [below, above] = boost::math::tools::toms748_solve(
      excess, low, high, atLow, atHigh, boost::math::tools::eps_tolerance<double>(46), steps);
  return 0.5 * (below + above);
}

}  // namespace limen::analysis

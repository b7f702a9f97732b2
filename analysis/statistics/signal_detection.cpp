// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/signal_detection.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "analysis/statistics/detail/check.h"
#include "analysis/statistics/detection_rates.h"
#include "analysis/statistics/distributions.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

constexpr double kLargestDPrime = 60.0;
constexpr int kMostAlternatives = 1000;

double correctedRate(int64_t successes, int64_t trials, RateCorrection correction, const std::string& where) {
  requireCounts(successes, trials, where, true);
  const auto k = static_cast<double>(successes), n = static_cast<double>(trials);
  if (correction == RateCorrection::kLogLinear) return (k + 0.5) / (n + 1.0);
  if (successes == 0 || successes == trials)
    throw Error(fmt::format("a rate of {} makes d' infinite", successes == 0 ? 0 : 1), where,
                "use the log-linear correction");
  return k / n;
}

double varianceOfZ(double rate, double z, int64_t trials) {
  const double density = normalDensity(z);
  return rate * (1.0 - rate) / (static_cast<double>(trials) * density * density);
}

/// Standard error of A' = 1/2 + (h - l)(1 + h - l) / (4 h (1 - l)), h the larger of the rates and l the
/// smaller (and 1 minus that below chance), of the rates' binomial errors.
double aPrimeErrorOf(double hitRate, double falseAlarmRate, double varH, double varF) {
  const bool above = hitRate >= falseAlarmRate;
  const double h = above ? hitRate : falseAlarmRate, l = above ? falseAlarmRate : hitRate, d = h - l;
  const double varHigh = above ? varH : varF, varLow = above ? varF : varH;
  const double scale = 4.0 * h * (1.0 - l), rise = 1.0 + 2.0 * d, share = d * (1.0 + d);
  const double byHigh = (rise - share / h) / scale, byLow = (share / (1.0 - l) - rise) / scale;
  return std::sqrt(byHigh * byHigh * varHigh + byLow * byLow * varLow);
}

void requireMAfc(double dPrime, int alternatives) {
  if (alternatives < 2 || alternatives > kMostAlternatives)
    throw Error(fmt::format("{} alternatives, give 2 to {}", alternatives, kMostAlternatives),
                "alternatives");
  if (!(std::abs(dPrime) <= kLargestDPrime))
    throw Error(fmt::format("{} is out of range, give -{} to {}", dPrime, kLargestDPrime, kLargestDPrime),
                "d'");
}

constexpr double kStep = 1.0 / 32.0;

/// Trapezoidal sums converge faster than any power of the step for such integrands; at this step their error
/// is below rounding. Outside of the range the integrand is below 1e-300 of its peak.
template <typename Integrand>
double integrate(double dPrime, Integrand integrand) {
  constexpr double kReach = 39.0;
  const double low = std::min(0.0, dPrime) - kReach, high = std::max(0.0, dPrime) + kReach;
  const int steps = static_cast<int>((high - low) / kStep);
  double sum = 0.0;
  for (int i = 0; i <= steps; ++i) sum += integrand(low + kStep * i);
  return sum * kStep;
}

/// ln of the integral of phi(x - d') times e to `logFactor` of ln Phi(x)^(m-1); in logarithms, so that
/// nothing underflows.
template <typename LogFactor>
double logIntegral(double dPrime, int alternatives, LogFactor logFactor) {
  std::vector<double> terms;
  double largest = -std::numeric_limits<double>::infinity();
  integrate(dPrime, [&](double x) {
    terms.push_back(-0.5 * (x - dPrime) * (x - dPrime) + logFactor((alternatives - 1) * logNormalLower(x)));
    largest = std::max(largest, terms.back());
    return 0.0;
  });
  double sum = 0.0;
  for (const double term : terms) sum += std::exp(term - largest);
  return largest + std::log(sum * kStep) - 0.5 * std::log(2.0 * std::numbers::pi);
}

double logCorrect(double dPrime, int alternatives) {
  return logIntegral(dPrime, alternatives, [](double logPower) { return logPower; });
}

double logWrong(double dPrime, int alternatives) {
  return logIntegral(dPrime, alternatives, [](double logPower) { return std::log(-std::expm1(logPower)); });
}

double slope(double dPrime, int alternatives) {
  return integrate(dPrime, [&](double x) {
    return (x - dPrime) * normalDensity(x - dPrime) * std::exp((alternatives - 1) * logNormalLower(x));
  });
}

}  // namespace

YesNoSensitivity analyseYesNo(const YesNoCounts& counts, RateCorrection correction, double level) {
  requireLevel(level);
  YesNoSensitivity s;
  s.hitRate = correctedRate(counts.hits, counts.signalTrials, correction, "hits");
  s.falseAlarmRate = correctedRate(counts.falseAlarms, counts.noiseTrials, correction, "falseAlarms");
  const double zH = normalQuantile(s.hitRate), zF = normalQuantile(s.falseAlarmRate);
  s.dPrime = zH - zF;
  s.criterion = -0.5 * (zH + zF);
  s.lnBeta = s.criterion * s.dPrime;
  s.beta = std::exp(s.lnBeta);
  s.aPrime = aPrime(s.hitRate, s.falseAlarmRate);

  const double varH = varianceOfZ(s.hitRate, zH, counts.signalTrials);
  const double varF = varianceOfZ(s.falseAlarmRate, zF, counts.noiseTrials);
  s.dPrimeError = std::sqrt(varH + varF);
  s.criterionError = 0.5 * s.dPrimeError;
  s.lnBetaError = std::sqrt(zH * zH * varH + zF * zF * varF);
  const auto binomial = [](double rate, int64_t trials) {
    return rate * (1.0 - rate) / static_cast<double>(trials);
  };
  s.aPrimeError = aPrimeErrorOf(s.hitRate, s.falseAlarmRate, binomial(s.hitRate, counts.signalTrials),
                                binomial(s.falseAlarmRate, counts.noiseTrials));
  const double z = criticalZ(level);
  s.dPrimeInterval = around(s.dPrime, z * s.dPrimeError);
  s.criterionInterval = around(s.criterion, z * s.criterionError);
  s.lnBetaInterval = around(s.lnBeta, z * s.lnBetaError);
  s.betaInterval = {std::exp(s.lnBetaInterval.low), std::exp(s.lnBetaInterval.high)};
  const Interval aPrime = around(s.aPrime, z * s.aPrimeError);
  s.aPrimeInterval = {std::max(0.0, aPrime.low), std::min(1.0, aPrime.high)};
  return s;
}

double aPrime(double hitRate, double falseAlarmRate) {
  const auto inRange = [](double rate, const char* where) {
    if (!(rate >= 0.0 && rate <= 1.0)) throw Error(fmt::format("{} is no rate", rate), where);
  };
  inRange(hitRate, "hitRate");
  inRange(falseAlarmRate, "falseAlarmRate");
  if (hitRate == falseAlarmRate) return 0.5;
  const double high = std::max(hitRate, falseAlarmRate), low = std::min(hitRate, falseAlarmRate);
  const double difference = high - low;
  const double beyondChance = difference * (1.0 + difference) / (4.0 * high * (1.0 - low));
  return hitRate > falseAlarmRate ? 0.5 + beyondChance : 0.5 - beyondChance;
}

double mAfcProportionCorrect(double dPrime, int alternatives) {
  requireMAfc(dPrime, alternatives);
  // Of two the exact integral has a closed form.
  if (alternatives == 2) return normalLower(dPrime / std::sqrt(2.0));
  return std::exp(logCorrect(dPrime, alternatives));
}

double mAfcProportionWrong(double dPrime, int alternatives) {
  requireMAfc(dPrime, alternatives);
  if (alternatives == 2) return normalUpper(dPrime / std::sqrt(2.0));
  return std::exp(logWrong(dPrime, alternatives));
}

double mAfcDPrime(double proportionCorrect, int alternatives) {
  requireMAfc(0.0, alternatives);
  if (!(proportionCorrect > 0.0 && proportionCorrect < 1.0))
    throw Error(fmt::format("a proportion of {} has no finite d'", proportionCorrect), "proportionCorrect",
                "give one between 0 and 1");
  if (alternatives == 2) return std::sqrt(2.0) * normalQuantile(proportionCorrect);
  // On a logarithmic scale of the smaller side, so that the far tails are found as well as the middle.
  const bool fromAbove = proportionCorrect > 0.5;
  const double target = std::log(fromAbove ? 1.0 - proportionCorrect : proportionCorrect);
  const auto excess = [&](double d) {
    return fromAbove ? target - logWrong(d, alternatives) : logCorrect(d, alternatives) - target;
  };
  double low = -1.0, high = 1.0;
  while (excess(low) > 0.0 && low > -kLargestDPrime) low = std::max(2.0 * low, -kLargestDPrime);
  while (excess(high) < 0.0 && high < kLargestDPrime) high = std::min(2.0 * high, kLargestDPrime);
  if (excess(low) > 0.0 || excess(high) < 0.0)
    throw Error(fmt::format("a proportion of {} is beyond d' = {}", proportionCorrect, kLargestDPrime),
                "proportionCorrect");
  if (excess(low) == 0.0) return low;
  if (excess(high) == 0.0) return high;
  std::uintmax_t steps = 200;
  const auto [below, above] = boost::math::tools::toms748_solve(
      excess, low, high, boost::math::tools::eps_tolerance<double>(50), steps);
  return 0.5 * (below + above);
}

MAfcSensitivity analyseMAfc(int64_t correct, int64_t trials, int alternatives, RateCorrection correction,
                            double level) {
  requireLevel(level);
  MAfcSensitivity s;
  s.proportionCorrect = correctedRate(correct, trials, correction, "correct");
  s.dPrime = mAfcDPrime(s.proportionCorrect, alternatives);
  s.dPrimeError = std::sqrt(s.proportionCorrect * (1.0 - s.proportionCorrect) / static_cast<double>(trials)) /
                  slope(s.dPrime, alternatives);
  const Interval p = wilsonInterval(correct, trials, level);
  if (p.low > 0.0) s.low = mAfcDPrime(p.low, alternatives);
  if (p.high < 1.0) s.high = mAfcDPrime(p.high, alternatives);
  return s;
}

}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/detection_rates.h"

#include <cmath>

#include "analysis/statistics/detail/check.h"
#include "analysis/statistics/distributions.h"
#include "experiments/base/error.h"

namespace limen::analysis {
Interval wilsonInterval(int64_t successes, int64_t trials, double level) {
  requireCounts(successes, trials, "successes", true);
  requireLevel(level);
  const auto n = static_cast<double>(trials), k = static_cast<double>(successes);
  const double z = criticalZ(level), z2 = z * z;
  const double centre = k + z2 / 2.0, reach = z * std::sqrt(k * (n - k) / n + z2 / 4.0);
  Interval interval{(centre - reach) / (n + z2), (centre + reach) / (n + z2)};
  if (successes == 0) interval.low = 0.0;
  if (successes == trials) interval.high = 1.0;
  return interval;
}

Interval clopperPearsonInterval(int64_t successes, int64_t trials, double level) {
  requireCounts(successes, trials, "successes", true);
  requireLevel(level);
  const auto n = static_cast<double>(trials), k = static_cast<double>(successes);
  const double tail = (1.0 - level) / 2.0;
  Interval interval{0.0, 1.0};
  if (successes > 0) interval.low = betaQuantile(tail, k, n - k + 1.0);
  // By symmetry, so that a bound next to 1 is as good as one next to 0.
  if (successes < trials) interval.high = 1.0 - betaQuantile(tail, n - k, k + 1.0);
  return interval;
}

Rate detectionRate(int64_t successes, int64_t trials, double level) {
  const Interval wilson = wilsonInterval(successes, trials, level);
  return {successes, trials, static_cast<double>(successes) / static_cast<double>(trials), wilson,
          clopperPearsonInterval(successes, trials, level)};
}

MeanOverSubjects meanOverSubjects(const std::vector<double>& values, double level) {
  requireAtLeast(values.size(), 1, "values");
  requireFinite(values, "values");
  requireLevel(level);
  MeanOverSubjects result;
  result.subjects = values.size();
  const auto n = static_cast<double>(values.size());
  // The sum is divided, not each value: subjects who all answered with the same share have exactly that mean.
  for (const double value : values) result.mean += value;
  result.mean /= n;
  if (values.size() == 1) return result;
  double squares = 0.0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  result.standardDeviation = std::sqrt(squares / (n - 1.0));
  result.standardError = *result.standardDeviation / std::sqrt(n);
  const double reach = tCritical(1.0 - level, n - 1.0) * *result.standardError;
  result.interval = around(result.mean, reach);
  return result;
}

MeanOverSubjects meanRateOverSubjects(const std::vector<double>& rates, double level) {
  for (const double rate : rates)
    if (!(rate >= 0.0 && rate <= 1.0)) throw Error(std::to_string(rate) + " is no rate from 0 to 1");
  MeanOverSubjects result = meanOverSubjects(rates, level);
  if (!result.interval) return result;
  result.interval.reset();
  if (result.mean > 0.0 && result.mean < 1.0)
    result.interval = logitInterval(result.mean, *result.standardError,
                                    tCritical(1.0 - level, static_cast<double>(rates.size()) - 1.0));
  return result;
}

Interval logitInterval(double mean, double error, double critical) {
  const double logit = std::log(mean / (1.0 - mean)), reach = critical * error / (mean * (1.0 - mean));
  const auto rate = [](double x) { return 1.0 / (1.0 + std::exp(-x)); };
  return {rate(logit - reach), rate(logit + reach)};
}

}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/bootstrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/math/special_functions/beta.hpp>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "analysis/psychometric/likelihood.h"
#include "analysis/statistics/log_math.h"
#include "analysis/statistics/rank_correlation.h"
#include "experiments/base/error.h"
#include "perception/psychometrics/random.h"

namespace limen::analysis {

using psychometrics::Random;

namespace {

/// 0 if either does not vary.
double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() < 2) return 0.0;
  const std::optional<Correlation> found = pearson(a, b);
  return found ? found->coefficient.value : 0.0;
}

AxisValues axisValues(const ConditionFit& fit, const SigmoidShape& shape) {
  AxisValues values = fit.values;
  values[indexOf(FitParameter::Threshold)] = shape.onAxis(values[indexOf(FitParameter::Threshold)]);
  return values;
}

/// Share of a beta distribution with mean `p` and a + b = 1 / r, and what is left of 1.
std::pair<double, double> drawShare(Random& random, double p, double q, double r) {
  const double a = p / r, b = q / r;
  if (!(a > 0.0) || !(b > 0.0)) return {p, q};
  constexpr double kNormal = 1e6;  // from there on the distribution is normal to six digits
  if (std::min(a, b) > kNormal) {
    const double share = std::clamp(p + random.normal() * std::sqrt(p * q * r / (1.0 + r)), 0.0, 1.0);
    return {share, 1.0 - share};
  }
  double left = 0.0;
  const double share = boost::math::ibeta_inv(a, b, random.uniform(), &left);
  return {share, left};
}

/// Successes of a beta-binomial: few trials by its urn (Polya), in which each answer adds `r` to the weight
/// of its kind; many by its share, in a time that does not depend on their number.
int64_t drawBetaBinomial(Random& random, int64_t n, double p, double q, double r) {
  constexpr int64_t kUrn = 10'000;
  if (n > kUrn) {
    const auto [share, left] = drawShare(random, p, q, r);
    return drawBinomial(random, n, share, left);
  }
  int64_t successes = 0;
  for (int64_t i = 0; i < n; ++i) {
    const double weight = p + r * static_cast<double>(successes), all = 1.0 + r * static_cast<double>(i);
    if (random.uniform() * all < weight) ++successes;
  }
  return successes;
}

Condition drawn(const Condition& condition, const ConditionFit& fit, const SigmoidShape& shape,
                Random& random, bool parametric) {
  Condition sample = condition;
  const AxisValues values = axisValues(fit, shape);
  const double r = rho(values[indexOf(FitParameter::Eta)]);
  for (Block& block : sample.blocks) {
    if (block.trials == 0) continue;
    if (!parametric) {
      const double n = static_cast<double>(block.trials);
      block.correct = drawBinomial(random, block.trials, static_cast<double>(block.correct) / n,
                                   static_cast<double>(block.trials - block.correct) / n);
      continue;
    }
    const Chance chance = chanceAt(shape, shape.onAxis(block.level), values);
    block.correct = r > 0.0 ? drawBetaBinomial(random, block.trials, chance.p, chance.q, r)
                            : drawBinomial(random, block.trials, chance.p, chance.q);
  }
  return sample;
}

Replicate replicateOf(const std::vector<Condition>& conditions, const Fit& fit,
                      const BootstrapOptions& options, size_t index) {
  const SigmoidShape shape(fit.settings);
  Random random(psychometrics::childSeed(options.seed, fmt::format("replicate {}", index)));
  std::vector<Condition> sample;
  for (size_t c = 0; c < conditions.size(); ++c)
    sample.push_back(drawn(conditions[c], fit.conditions[c], shape, random, options.parametric));
  Replicate replicate;
  try {
    const Fit again = fitPsychometric(sample, fit.settings);
    for (size_t c = 0; c < conditions.size(); ++c) {
      const Residuals residuals = residualsOf(sample[c], again.conditions[c], fit.settings);
      replicate.conditions.push_back({quantitiesOf(again.conditions[c]), again.conditions[c].deviance,
                                      residuals.withPrediction, residuals.withOrder});
    }
    replicate.fitted = true;
  } catch (const Error&) {
    // Impossible answers under fixed rates: told apart by `fitted`.
  }
  return replicate;
}

}  // namespace

int64_t drawBinomial(Random& random, int64_t n, double p, double q) {
  // The walk below takes as many steps as the SD is long; from a thousand millions of trials on nobody can
  // tell the distribution from a normal one.
  constexpr double kNormalVariance = 1e9;
  if (const double variance = static_cast<double>(n) * p * q; variance > kNormalVariance)
    return static_cast<int64_t>(
        std::clamp(std::round(static_cast<double>(n) * p + random.normal() * std::sqrt(variance)), 0.0,
                   std::nextafter(static_cast<double>(n), 0.0)));
  return binomialAt(random.uniform(), n, p, q);
}

FitQuantities quantitiesOf(const ConditionFit& fit) {
  FitQuantities quantities{};
  std::copy(fit.values.begin(), fit.values.end(), quantities.begin());
  quantities[kFitParameters] = fit.slope;
  return quantities;
}

Residuals residualsOf(const Condition& condition, const ConditionFit& fit, const FitSettings& settings) {
  const SigmoidShape shape(settings);
  const AxisValues values = axisValues(fit, shape);
  Residuals residuals;
  std::vector<double> order;
  for (const Block& block : condition.blocks) {
    if (block.trials == 0) continue;
    const Chance chance = chanceAt(shape, shape.onAxis(block.level), values);
    const double share = static_cast<double>(block.correct) / static_cast<double>(block.trials);
    const double size = std::sqrt(2.0 * halfBlockDeviance(chance, block.correct, block.trials));
    residuals.levels.push_back(block.level);
    residuals.predicted.push_back(chance.p);
    residuals.values.push_back(share < chance.p ? -size : size);
    order.push_back(block.order);
  }
  residuals.withPrediction = correlation(residuals.values, residuals.predicted);
  residuals.withOrder = correlation(residuals.values, order);
  return residuals;
}

std::vector<Replicate> bootstrap(const std::vector<Condition>& conditions, const Fit& fit,
                                 const BootstrapOptions& options) {
  std::vector<Replicate> replicates(options.samples);
  inThreads(options.samples, options.threads,
            [&](size_t i) { replicates[i] = replicateOf(conditions, fit, options, i); });
  return replicates;
}

void inThreads(size_t count, unsigned threads, const std::function<void(size_t)>& work) {
  std::atomic<size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto take = [&] {
    try {
      for (size_t i; (i = next++) < count;) work(i);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(mutex);
      failure = std::current_exception();
      next = count;
    }
  };
  std::vector<std::thread> others;
  for (unsigned t = 1; t < threads; ++t) others.emplace_back(take);
  take();
  for (std::thread& other : others) other.join();
  if (failure) std::rethrow_exception(failure);
}

std::vector<double> sortedQuantity(const std::vector<Replicate>& replicates, size_t condition,
                                   size_t quantity) {
  std::vector<double> values;
  for (const Replicate& replicate : replicates)
    if (replicate.fitted) values.push_back(replicate.conditions[condition].quantities[quantity]);
  std::sort(values.begin(), values.end());
  return values;
}

}  // namespace limen::analysis

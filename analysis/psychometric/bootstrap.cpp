// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/bootstrap.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <boost/math/special_functions/beta.hpp>
#include <cassert>
#include <cmath>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

#include "analysis/psychometric/likelihood.h"
#include "analysis/psychometric/log_math.h"
#include "experiments/base/error.h"
#include "perception/psychometrics/random.h"

namespace limen::analysis {

using psychometrics::Random;

namespace {

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double meanA = 0.0, meanB = 0.0;
  const double n = static_cast<double>(a.size());
  for (size_t i = 0; i < a.size(); ++i) {
    meanA += a[i] / n;
    meanB += b[i] / n;
  }
  double ab = 0.0, aa = 0.0, bb = 0.0;
  for (size_t i = 0; i < a.size(); ++i) {
    ab += (a[i] - meanA) * (b[i] - meanB);
    aa += (a[i] - meanA) * (a[i] - meanA);
    bb += (b[i] - meanB) * (b[i] - meanB);
  }
  return aa > 0.0 && bb > 0.0 ? std::clamp(ab / std::sqrt(aa * bb), -1.0, 1.0) : 0.0;
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
  const double u = random.uniform();
  if (n == 0 || p <= 0.0) return 0;
  if (q <= 0.0) return n;
  const double dn = static_cast<double>(n);
  const int64_t mode = std::min(n, static_cast<int64_t>(std::floor((dn + 1.0) * p)));
  const double logN = std::log(dn), dm = static_cast<double>(mode);
  const double atMode = std::exp(logSaturatedChance(mode, n) - halfDeviance(dm, dn * p, logN + std::log(p)) -
                                 halfDeviance(dn - dm, dn * q, logN + std::log(q)));
  double left = u - atMode;
  if (left < 0.0) return mode;
  int64_t down = mode, up = mode;
  double chanceDown = atMode, chanceUp = atMode;
  const double odds = p / q;
  while (true) {
    const bool canDown = down > 0 && chanceDown > 0.0, canUp = up < n && chanceUp > 0.0;
    if (!canDown && !canUp) return mode;  // what rounding leaves over
    if (canUp) {
      chanceUp *= odds * static_cast<double>(n - up) / static_cast<double>(up + 1);
      ++up;
      if ((left -= chanceUp) < 0.0) return up;
    }
    if (canDown) {
      chanceDown *= static_cast<double>(down) / (odds * static_cast<double>(n - down + 1));
      --down;
      if ((left -= chanceDown) < 0.0) return down;
    }
  }
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

double sortedQuantile(const std::vector<double>& sorted, double p) {
  assert(!sorted.empty());
  const double at = std::clamp(p, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
  const size_t below = static_cast<size_t>(at);
  if (below + 1 >= sorted.size()) return sorted.back();
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[below + 1] - sorted[below]);
}

}  // namespace limen::analysis

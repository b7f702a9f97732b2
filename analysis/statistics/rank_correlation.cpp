// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/rank_correlation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "analysis/statistics/detail/check.h"
#include "analysis/statistics/detail/ranks.h"
#include "analysis/statistics/distributions.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

constexpr size_t kExactSpearman = 9;
constexpr double kSure = 1e-12;  ///< what averaging may take off a rate of 1

/// Error on Fisher's scale is `factor` / sqrt(n - 3).
Coefficient withFisher(double r, double n, double factor, double level) {
  Coefficient c{r, {}, {}};
  if (n < 4.0) return c;
  const double error = factor / std::sqrt(n - 3.0);
  c.standardError = (1.0 - r * r) * error;
  const Interval fisher = around(std::atanh(r), criticalZ(level) * error);
  c.interval = Interval{std::tanh(fisher.low), std::tanh(fisher.high)};
  return c;
}

struct ProductMoment {
  double r = 0.0;
  double rest = 0.0;  ///< 1 - r^2
};

std::optional<ProductMoment> productMoment(const std::vector<double>& x, const std::vector<double>& y) {
  const auto centred = [](const std::vector<double>& v) -> std::optional<std::vector<double>> {
    const auto [low, high] = std::minmax_element(v.begin(), v.end());
    if (*low == *high) return std::nullopt;
    // Scaled by the range, halves first: squares of neither huge nor tiny values may leave the range of
    // doubles.
    const double scale = 0.5 * *high - 0.5 * *low, middle = 0.5 * *high + 0.5 * *low;
    std::vector<double> out;
    double mean = 0.0;
    for (const double value : v) {
      out.push_back((0.5 * value - 0.5 * middle) / scale);
      mean += out.back() / static_cast<double>(v.size());
    }
    double length = 0.0;
    for (double& value : out) {
      value -= mean;
      length += value * value;
    }
    for (double& value : out) value /= std::sqrt(length);
    return out;
  };
  const auto a = centred(x), b = centred(y);
  if (!a || !b) return std::nullopt;
  double sum = 0.0, difference = 0.0, total = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    sum += (*a)[i] * (*b)[i];
    difference += std::pow((*a)[i] - (*b)[i], 2.0);
    total += std::pow((*a)[i] + (*b)[i], 2.0);
  }
  // (1 - r)(1 + r) from unit vectors: keeps its digits next to a perfect correlation.
  const double rest = 0.25 * difference * total;
  return ProductMoment{std::clamp(sum, -1.0, 1.0), rest < 1e-30 ? 0.0 : rest};
}

double pOfR(const ProductMoment& m, double n) {
  if (m.rest == 0.0) return 0.0;
  return tTwoSided(m.r * std::sqrt((n - 2.0) / m.rest), n - 2.0);
}

/// P(|r| >= |observed|) over all orders of n ranks without ties.
double exactSpearman(size_t n, double observed) {
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  const double mean = 0.5 * static_cast<double>(n - 1);
  double length = 0.0;
  for (size_t i = 0; i < n; ++i) length += std::pow(static_cast<double>(i) - mean, 2.0);
  int64_t all = 0, beyond = 0;
  do {
    int64_t product = 0;
    for (size_t i = 0; i < n; ++i) product += static_cast<int64_t>(i) * order[i];
    const double r = (static_cast<double>(product) - static_cast<double>(n) * mean * mean) / length;
    ++all;
    // Steps of r are 1/120 or wider.
    beyond += std::abs(r) >= std::abs(observed) - 1e-6 ? 1 : 0;
  } while (std::next_permutation(order.begin(), order.end()));
  return static_cast<double>(beyond) / static_cast<double>(all);
}

}  // namespace

std::optional<Correlation> pearson(const std::vector<double>& x, const std::vector<double>& y, double level) {
  requireSample(x, "x", y, "y", level);
  const auto moment = productMoment(x, y);
  if (!moment) return std::nullopt;
  const auto n = static_cast<double>(x.size());
  Correlation c{x.size(), withFisher(moment->r, n, 1.0, level), {}, false};
  if (x.size() >= 3) c.p = pOfR(*moment, n);
  return c;
}

std::optional<Correlation> spearman(const std::vector<double>& x, const std::vector<double>& y,
                                    double level) {
  requireSample(x, "x", y, "y", level);
  const Ranks ranksX = rank(x), ranksY = rank(y);
  const auto moment = productMoment(ranksX.ranks, ranksY.ranks);
  if (!moment) return std::nullopt;
  const auto n = static_cast<double>(x.size());
  Correlation c{
      x.size(), withFisher(moment->r, n, std::sqrt(1.0 + 0.5 * moment->r * moment->r), level), {}, false};
  c.exact =
      x.size() <= kExactSpearman && ranksX.tieSizes.size() == x.size() && ranksY.tieSizes.size() == x.size();
  if (c.exact)
    c.p = exactSpearman(x.size(), moment->r);
  else if (x.size() >= 3)
    c.p = pOfR(*moment, n);
  return c;
}

ClampedPearson clampedPearson(const std::vector<double>& predictions, const std::vector<double>& rates,
                              double level) {
  requireSample(predictions, "predictions", rates, "rates", level);
  ClampedPearson result;
  for (size_t i = 0; i < rates.size(); ++i) {
    if (rates[i] < 0.0 || rates[i] > 1.0)
      throw Error(fmt::format("{} is no rate", rates[i]), indexed("rates", i),
                  "give fractions, not per cent");
    if (rates[i] >= 1.0 - kSure)
      result.clamp = std::min(result.clamp.value_or(predictions[i]), predictions[i]);
  }
  std::vector<double> lowered = predictions;
  if (result.clamp)
    for (double& value : lowered)
      if (value > *result.clamp) {
        value = *result.clamp;
        ++result.clamped;
      }
  result.correlation = pearson(lowered, rates, level);
  return result;
}

}  // namespace limen::analysis

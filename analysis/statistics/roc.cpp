// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/roc.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "analysis/statistics/detail/check.h"
#include "analysis/statistics/detail/ranks.h"
#include "analysis/statistics/detection_rates.h"
#include "analysis/statistics/distributions.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

constexpr size_t kMostBins = 1000;

void checkOutcomes(const std::vector<double>& scores, const char* name, const std::vector<int>& outcomes) {
  requireSameLength(scores.size(), name, outcomes.size(), "outcomes");
  requireAtLeast(scores.size(), 1, name);
  requireFinite(scores, name);
  for (size_t i = 0; i < outcomes.size(); ++i)
    if (outcomes[i] != 0 && outcomes[i] != 1)
      throw Error(fmt::format("{} is neither 0 nor 1", outcomes[i]), indexed("outcomes", i));
}

void requireBoth(const std::vector<int>& outcomes) {
  const auto positives = std::count(outcomes.begin(), outcomes.end(), 1);
  if (positives == 0 || positives == static_cast<std::ptrdiff_t>(outcomes.size()))
    throw Error(fmt::format("all outcomes are {}, so there is nothing to tell apart", positives == 0 ? 0 : 1),
                "outcomes");
}

/// Of each positive the share of negatives below it, of each negative the share of positives above it; ties
/// count half.
struct Placements {
  std::vector<double> positives, negatives;
  double area = 0.0;
};

Placements place(const std::vector<double>& scores, const std::vector<int>& outcomes) {
  std::vector<double> high, low;
  for (size_t i = 0; i < scores.size(); ++i) (outcomes[i] == 1 ? high : low).push_back(scores[i]);
  const std::vector<double> all = rank(scores).ranks, amongHigh = rank(high).ranks,
                            amongLow = rank(low).ranks;
  const auto m = static_cast<double>(high.size()), n = static_cast<double>(low.size());
  Placements p;
  double sum = 0.0;
  for (size_t i = 0; i < scores.size(); ++i) {
    if (outcomes[i] == 1) {
      const double below = all[i] - amongHigh[p.positives.size()];
      sum += below;
      p.positives.push_back(below / n);
    } else {
      p.negatives.push_back(1.0 - (all[i] - amongLow[p.negatives.size()]) / m);
    }
  }
  p.area = sum / (m * n);
  return p;
}

double covarianceOf(const std::vector<double>& a, double meanA, const std::vector<double>& b, double meanB) {
  double sum = 0.0;
  for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - meanA) * (b[i] - meanB);
  return sum / static_cast<double>(a.size() - 1);
}

/// Of the two areas; none with fewer than 2 of either outcome.
std::optional<double> covarianceOf(const Placements& a, const Placements& b) {
  if (a.positives.size() < 2 || a.negatives.size() < 2) return std::nullopt;
  return covarianceOf(a.positives, a.area, b.positives, b.area) / static_cast<double>(a.positives.size()) +
         covarianceOf(a.negatives, a.area, b.negatives, b.area) / static_cast<double>(a.negatives.size());
}

RocArea areaOf(const Placements& p, double level) {
  RocArea result{p.positives.size(), p.negatives.size(), p.area, covarianceOf(p, p), {}, {}};
  if (!result.variance) return result;
  const double reach = criticalZ(level) * std::sqrt(*result.variance);
  result.interval = Interval{std::max(0.0, p.area - reach), std::min(1.0, p.area + reach)};
  if (p.area > 0.0 && p.area < 1.0) {
    const double logit = std::log(p.area / (1.0 - p.area)), wide = reach / (p.area * (1.0 - p.area));
    result.logitInterval =
        Interval{1.0 / (1.0 + std::exp(wide - logit)), 1.0 / (1.0 + std::exp(-wide - logit))};
  }
  return result;
}

}  // namespace

std::vector<RocPoint> rocPoints(const std::vector<double>& scores, const std::vector<int>& outcomes) {
  checkOutcomes(scores, "scores", outcomes);
  requireBoth(outcomes);
  std::vector<size_t> order(scores.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return scores[a] > scores[b]; });
  const auto positives = static_cast<double>(std::count(outcomes.begin(), outcomes.end(), 1));
  const double negatives = static_cast<double>(outcomes.size()) - positives;
  std::vector<RocPoint> points{{std::numeric_limits<double>::infinity(), 0.0, 0.0}};
  double hits = 0.0, falseAlarms = 0.0;
  for (size_t i = 0; i < order.size(); ++i) {
    (outcomes[order[i]] == 1 ? hits : falseAlarms) += 1.0;
    if (i + 1 < order.size() && scores[order[i + 1]] == scores[order[i]]) continue;
    points.push_back({scores[order[i]], falseAlarms / negatives, hits / positives});
  }
  return points;
}

RocArea rocArea(const std::vector<double>& scores, const std::vector<int>& outcomes, double level) {
  checkOutcomes(scores, "scores", outcomes);
  requireBoth(outcomes);
  requireLevel(level);
  return areaOf(place(scores, outcomes), level);
}

RocComparison compareRocAreas(const std::vector<double>& first, const std::vector<double>& second,
                              const std::vector<int>& outcomes, double level) {
  checkOutcomes(first, "first", outcomes);
  checkOutcomes(second, "second", outcomes);
  requireBoth(outcomes);
  requireLevel(level);
  const Placements a = place(first, outcomes), b = place(second, outcomes);
  RocComparison c;
  c.first = areaOf(a, level);
  c.second = areaOf(b, level);
  c.difference = a.area - b.area;
  c.covariance = covarianceOf(a, b);
  if (!c.covariance) return c;
  const double variance = *c.first.variance + *c.second.variance - 2.0 * *c.covariance;
  // Scores that order the trials alike leave rounding only.
  if (variance <= 1e-14 * (*c.first.variance + *c.second.variance)) {
    if (std::abs(c.difference) < 1e-12) c.p = 1.0;
    return c;
  }
  const double error = std::sqrt(variance);
  c.interval = around(c.difference, criticalZ(level) * error);
  c.z = c.difference / error;
  c.p = normalTwoSided(*c.z);
  return c;
}

Calibration calibrate(const std::vector<double>& probabilities, const std::vector<int>& outcomes, size_t bins,
                      double level) {
  checkOutcomes(probabilities, "probabilities", outcomes);
  requireLevel(level);
  if (bins < 1 || bins > kMostBins)
    throw Error(fmt::format("{} bins, give 1 to {}", bins, kMostBins), "bins");
  for (size_t i = 0; i < probabilities.size(); ++i)
    if (probabilities[i] < 0.0 || probabilities[i] > 1.0)
      throw Error(fmt::format("{} is no probability", probabilities[i]), indexed("probabilities", i));

  Calibration c;
  const auto width = static_cast<double>(bins);
  for (size_t b = 0; b < bins; ++b)
    c.bins.push_back(
        {static_cast<double>(b) / width, static_cast<double>(b + 1) / width, 0, 0, 0.0, 0.0, {}});
  std::vector<size_t> binOf;
  for (size_t i = 0; i < probabilities.size(); ++i) {
    auto b = std::min(bins - 1, static_cast<size_t>(probabilities[i] * width));
    // The product may round across an edge that the bin states.
    if (probabilities[i] < c.bins[b].low) --b;
    if (b + 1 < bins && probabilities[i] >= c.bins[b].high) ++b;
    binOf.push_back(b);
    ++c.bins[b].trials;
    c.bins[b].positives += outcomes[i];
    c.bins[b].meanPrediction += probabilities[i];
  }
  const auto n = static_cast<double>(probabilities.size());
  const double base = static_cast<double>(std::count(outcomes.begin(), outcomes.end(), 1)) / n;
  c.uncertainty = base * (1.0 - base);
  for (CalibrationBin& bin : c.bins) {
    if (bin.trials == 0) continue;
    const auto trials = static_cast<double>(bin.trials);
    bin.meanPrediction /= trials;
    bin.observed = static_cast<double>(bin.positives) / trials;
    bin.wilson = wilsonInterval(bin.positives, bin.trials, level);
    c.reliability += trials / n * std::pow(bin.meanPrediction - bin.observed, 2.0);
    c.resolution += trials / n * std::pow(bin.observed - base, 2.0);
  }
  for (size_t i = 0; i < probabilities.size(); ++i) {
    const CalibrationBin& bin = c.bins[binOf[i]];
    const double off = probabilities[i] - bin.meanPrediction;
    c.brier += std::pow(probabilities[i] - outcomes[i], 2.0) / n;
    c.withinVariance += off * off / n;
    c.withinCovariance += 2.0 * off * (outcomes[i] - bin.observed) / n;
  }
  return c;
}

}  // namespace limen::analysis

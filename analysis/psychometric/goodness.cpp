// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/goodness.h"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/summary.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

MonteCarloTest compare(double value, std::vector<double> drawn, bool upperOnly) {
  MonteCarloTest test;
  test.value = value;
  if (drawn.empty()) return test;
  std::sort(drawn.begin(), drawn.end());
  test.low = upperOnly ? 0.0 : sortedQuantile(drawn, 0.025);
  test.high = sortedQuantile(drawn, upperOnly ? 0.95 : 0.975);
  const double slack = 1e-9 * std::abs(value);
  const auto extreme = std::count_if(drawn.begin(), drawn.end(), [&](double other) {
    return upperOnly ? other >= value - slack : std::abs(other) >= std::abs(value) - slack;
  });
  test.p = (1.0 + static_cast<double>(extreme)) / (1.0 + static_cast<double>(drawn.size()));
  return test;
}

std::vector<BlockInfluence> influencesOf(const std::vector<Condition>& conditions, const Fit& fit, size_t c,
                                         const std::vector<Replicate>& replicates) {
  std::vector<BlockInfluence> influences;
  const std::vector<double> thresholds = sortedQuantity(replicates, c, indexOf(FitParameter::Threshold));
  const std::vector<double> widths = sortedQuantity(replicates, c, indexOf(FitParameter::Width));
  const auto outside = [](const std::vector<double>& sorted, double value) {
    if (sorted.empty()) return false;
    // Fixed parameters come back the same but for rounding.
    const double slack = 1e-9 * std::abs(value);
    return value < sortedQuantile(sorted, 0.025) - slack || value > sortedQuantile(sorted, 0.975) + slack;
  };
  std::vector<Condition> without = conditions;
  for (size_t b = 0; b < conditions[c].blocks.size(); ++b) {
    const Block& block = conditions[c].blocks[b];
    if (block.trials == 0) continue;
    without[c].blocks.erase(without[c].blocks.begin() + static_cast<std::ptrdiff_t>(b));
    BlockInfluence influence;
    influence.level = block.level;
    try {
      const ConditionFit less = fitPsychometric(without, fit.settings).conditions[c];
      influence.threshold = less.value(FitParameter::Threshold);
      influence.width = less.value(FitParameter::Width);
      influence.influential = outside(thresholds, influence.threshold) || outside(widths, influence.width);
    } catch (const Error&) {
      influence.refused = influence.influential = true;
    }
    influences.push_back(influence);
    without[c] = conditions[c];
  }
  return influences;
}

}  // namespace

std::vector<Goodness> goodnessOfFit(const std::vector<Condition>& conditions, const Fit& fit,
                                    const std::vector<Replicate>& replicates) {
  std::vector<Goodness> all;
  for (size_t c = 0; c < conditions.size(); ++c) {
    Goodness goodness;
    goodness.residuals = residualsOf(conditions[c], fit.conditions[c], fit.settings);
    std::vector<double> deviances, predictions, orders;
    for (const Replicate& replicate : replicates) {
      if (!replicate.fitted) continue;
      deviances.push_back(replicate.conditions[c].deviance);
      predictions.push_back(replicate.conditions[c].withPrediction);
      orders.push_back(replicate.conditions[c].withOrder);
    }
    goodness.deviance = compare(fit.conditions[c].deviance, std::move(deviances), true);
    goodness.withPrediction = compare(goodness.residuals.withPrediction, std::move(predictions), false);
    goodness.withOrder = compare(goodness.residuals.withOrder, std::move(orders), false);
    goodness.influences = influencesOf(conditions, fit, c, replicates);
    all.push_back(std::move(goodness));
  }
  return all;
}

}  // namespace limen::analysis

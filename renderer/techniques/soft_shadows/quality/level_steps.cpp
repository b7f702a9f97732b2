// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/quality/level_steps.h"

#include <algorithm>
#include <cmath>

#include "perception/metrics/quantile.h"

namespace limen::techniques {
namespace {

constexpr double kUsualShare = 0.99;

std::vector<Counter> levelStepFacts(double largest, double usual, double mean, double changes) {
  return {{"level_step_max", largest},
          {"level_step_p99", usual},
          {"level_step_mean", mean},
          {"level_changes_per_px", changes}};
}

}  // namespace

std::vector<Counter> levelStepCounters(const LevelSteps& steps) {
  std::vector<double> changes;
  double sum = 0.0, pairs = 0.0, processed = 0.0;
  for (size_t i = 0; i < steps.own.data.size(); i += 2) {
    const float choice = steps.own.data[i + 1];
    if (choice < 0.0F) continue;
    processed += 1.0;
    for (const Image* neighbour : {&steps.right, &steps.below}) {
      const float other = neighbour->data[i + 1];
      if (other < 0.0F) continue;
      pairs += 1.0;
      if (other == choice) continue;
      const double step = std::abs(double{steps.own.data[i]} - neighbour->data[i]);
      if (!std::isfinite(step)) return {};
      changes.push_back(step);
      sum += step;
    }
  }
  const double perPixel = processed > 0.0 ? double(changes.size()) / processed : 0.0;
  const double largest = changes.empty() ? 0.0 : *std::max_element(changes.begin(), changes.end());
  return levelStepFacts(largest, perception::nearestRank(changes, kUsualShare),
                        pairs > 0.0 ? sum / pairs : 0.0, perPixel);
}

std::vector<Quantity> levelStepQuantities() {
  constexpr const char* kSource = "Schwarz 2009, section 5.2.2";
  return {{"level_step_max", "Largest step between levels", "", Direction::Neither, kSource},
          {"level_step_p99", "99th percentile of steps between levels", "", Direction::Neither, kSource},
          {"level_step_mean", "Mean step between levels", "", Direction::Neither, kSource},
          {"level_changes_per_px", "Changes of level per pixel", "1/px", Direction::Neither, kSource}};
}

}  // namespace limen::techniques

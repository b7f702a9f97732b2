// SPDX-License-Identifier: BSD-3-Clause
#include "study/observers/true_threshold.h"

#include <cmath>
#include <functional>

#include "study/procedures/threshold_target.h"

namespace limen::study {

std::optional<double> trueThreshold(SimulatedObserver& observer, const Trial& trial,
                                    const ProcedureSettings& settings, const Estimate& estimate) {
  if (settings.stimulus.size() != 1 || observer.usesModel(trial)) return std::nullopt;
  const std::optional<ThresholdTarget> target = thresholdTarget(settings, estimate);
  if (!target) return std::nullopt;
  const StimulusDimension& dimension = settings.stimulus.front();
  const std::function<double(double)> excess = [&](double x) {
    const Variables axes = {{dimension.name, x}};
    return (target->ofF ? observer.detected(trial, axes) : observer.probability(trial, axes)) - target->value;
  };
  // Outwards from the procedure's range, since a threshold may lie beyond it.
  double low = std::isfinite(dimension.minimum) ? dimension.minimum : -1.0;
  double high = std::isfinite(dimension.maximum) ? dimension.maximum : 1.0;
  const double positiveFrom = low > 0.0 ? low : 0.0;
  for (int i = 0; i < 60 && (excess(low) > 0.0) == (excess(high) > 0.0); ++i) {
    const double span = high - low;
    low = positiveFrom > 0.0 ? low / 2.0 : low - span / 2.0;
    high += span / 2.0;
  }
  const bool above = excess(low) > 0.0;
  if (above == (excess(high) > 0.0)) return std::nullopt;
  for (int i = 0; i < 200; ++i) {
    const double middle = low + (high - low) / 2.0;
    if (middle <= low || middle >= high) break;
    ((excess(middle) > 0.0) == above ? low : high) = middle;
  }
  return low + (high - low) / 2.0;
}

}  // namespace limen::study

// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/psychometric/intervals.h"
#include "analysis/statistics/distributions.h"
#include "analysis/statistics/summary.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

bool varies(const ConditionFit& fit, size_t quantity) {
  if (quantity < kFitParameters) return fit.fitted[quantity];
  return fit.fitted[indexOf(FitParameter::Threshold)] || fit.fitted[indexOf(FitParameter::Width)];
}

/// Estimates with one trial less of each kind in each block of condition `c`, with how many trials are like
/// it.
struct Deletion {
  double weight;
  FitQuantities quantities;
};

std::vector<Deletion> jackknife(const std::vector<Condition>& conditions, const Fit& fit, size_t c) {
  std::vector<Deletion> deletions;
  std::vector<Condition> without = conditions;
  for (Block& block : without[c].blocks) {
    const Block whole = block;
    for (const bool correct : {true, false}) {
      const int64_t alike = correct ? whole.correct : whole.trials - whole.correct;
      if (alike == 0) continue;
      block.trials = whole.trials - 1;
      block.correct = whole.correct - (correct ? 1 : 0);
      try {
        const Fit less = fitPsychometric(without, fit.settings);
        deletions.push_back({static_cast<double>(alike), quantitiesOf(less.conditions[c])});
      } catch (const Error&) {
        // The last trial that told something: its influence cannot be put in a number.
      }
    }
    block = whole;
  }
  return deletions;
}

double acceleration(const std::vector<Deletion>& deletions, size_t quantity) {
  double weight = 0.0, mean = 0.0;
  for (const Deletion& deletion : deletions) {
    weight += deletion.weight;
    mean += deletion.weight * deletion.quantities[quantity];
  }
  mean /= weight;
  double second = 0.0, third = 0.0;
  for (const Deletion& deletion : deletions) {
    const double d = mean - deletion.quantities[quantity];
    second += deletion.weight * d * d;
    third += deletion.weight * d * d * d;
  }
  return second > 0.0 ? third / (6.0 * std::pow(second, 1.5)) : 0.0;
}

/// Part of the replicates below the estimate; those equal to it (rates at a bound) count half.
double partBelow(const std::vector<double>& sorted, double estimate) {
  const double slack = 1e-9 * std::abs(estimate);
  const auto low = std::lower_bound(sorted.begin(), sorted.end(), estimate - slack);
  const auto high = std::upper_bound(sorted.begin(), sorted.end(), estimate + slack);
  return (static_cast<double>(low - sorted.begin()) + 0.5 * static_cast<double>(high - low)) /
         static_cast<double>(sorted.size());
}

}  // namespace

std::optional<FitInterval> slopeOfWidth(const ConditionFit& fit, const FitSettings& settings,
                                        const ConditionIntervals& intervals) {
  const auto& width = intervals[indexOf(FitParameter::Width)];
  if (!width || settings.logarithmic()) return {};
  const double constant = fit.slope * fit.value(FitParameter::Width);
  FitInterval out{{constant / width->high, constant / width->low}, width->highOpen, width->lowOpen};
  if (settings.falling) {
    std::swap(out.low, out.high);
    std::swap(out.lowOpen, out.highOpen);
  }
  return out;
}

FitIntervals bootstrapIntervals(const std::vector<Condition>& conditions, const Fit& fit,
                                const std::vector<Replicate>& replicates, bool accelerated,
                                double confidence) {
  FitIntervals intervals{accelerated ? IntervalMethod::Bca : IntervalMethod::Bootstrap, confidence, {}, {}};
  const auto fitted = static_cast<size_t>(
      std::count_if(replicates.begin(), replicates.end(), [](const Replicate& r) { return r.fitted; }));
  if (fitted < replicates.size())
    intervals.warnings.push_back(
        fmt::format("{} of {} bootstrap samples could not be fitted and are left out",
                    replicates.size() - fitted, replicates.size()));
  if (2 * fitted < replicates.size() || fitted < 2)
    throw Error("too few bootstrap samples can be fitted", "intervals", "free the rates or choose 'profile'");
  const double tail = 0.5 * (1.0 - confidence), zTail = normalQuantile(tail);
  for (size_t c = 0; c < conditions.size(); ++c) {
    const ConditionFit& own = fit.conditions[c];
    if (own.atBound[indexOf(FitParameter::Threshold)] != 0 ||
        own.atBound[indexOf(FitParameter::Width)] != 0) {
      // Samples drawn from a step are steps again, all alike: they would make certain what nobody knows.
      intervals.warnings.push_back(
          own.prefix() + std::string("no bootstrap intervals, as the fit is at a bound; 'profile' and "
                                     "'posterior' say what the answers leave open"));
      intervals.conditions.emplace_back();
      continue;
    }
    const std::vector<Deletion> deletions =
        accelerated ? jackknife(conditions, fit, c) : std::vector<Deletion>{};
    const FitQuantities estimates = quantitiesOf(fit.conditions[c]);
    ConditionIntervals found;
    for (size_t i = 0; i < kFitQuantities; ++i) {
      if (!varies(fit.conditions[c], i)) continue;
      const std::vector<double> sorted = sortedQuantity(replicates, c, i);
      double low = tail, high = 1.0 - tail;
      if (accelerated && !deletions.empty()) {
        // An estimate outside all replicates would send the correction to infinity.
        const double half = 0.5 / static_cast<double>(sorted.size());
        const double z0 = normalQuantile(std::clamp(partBelow(sorted, estimates[i]), half, 1.0 - half));
        const double a = acceleration(deletions, i);
        const auto corrected = [&](double z) {
          const double denominator = 1.0 - a * (z0 + z);
          return denominator > 0.0 ? normalLower(z0 + (z0 + z) / denominator) : (z0 + z > 0.0 ? 1.0 : 0.0);
        };
        low = corrected(zTail);
        high = corrected(-zTail);
      }
      const double from = sortedQuantile(sorted, low), to = sortedQuantile(sorted, high);
      if (from < to) {
        found[i] = FitInterval{{from, to}};
      } else {
        intervals.warnings.push_back(own.prefix() + std::string("no interval where all samples agree: ") +
                                     (i < kFitParameters ? fitParameterNames()[i] : "slope"));
      }
    }
    intervals.conditions.push_back(found);
  }
  return intervals;
}

}  // namespace limen::analysis

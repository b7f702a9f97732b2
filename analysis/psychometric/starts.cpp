// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/optimiser.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace limen::analysis {
namespace {

struct Start {
  std::vector<double> x;
  double value, u, width;
};

std::vector<double> evenly(double low, double high, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * (i + 0.5) / count);
  return values;
}

/// What the grid tries of one parameter; the fixed value alone if it is not free.
std::vector<double> candidates(const Objective& objective, FitParameter parameter,
                               const std::vector<double>& parts, double fixed) {
  const int place = objective.place(0, parameter);
  if (place < 0) return {fixed};
  std::vector<double> values;
  const double high = objective.free()[static_cast<size_t>(place)].high;
  for (const double part : parts)
    if (part < high) values.push_back(part);
  return values.empty() ? std::vector<double>{0.5 * high} : values;
}

/// Blocks whose levels thresholds are tried at: all, or some of many.
std::vector<size_t> anchors(const PreparedBlocks& blocks) {
  constexpr size_t kMost = 24;
  std::vector<size_t> order;
  for (size_t i = 0; i < blocks.u.size(); ++i)
    if (std::isfinite(blocks.u[i])) order.push_back(i);
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return blocks.u[a] < blocks.u[b]; });
  if (order.size() <= kMost) return order;
  std::vector<size_t> some;
  for (size_t i = 0; i < kMost; ++i) some.push_back(order[i * (order.size() - 1) / (kMost - 1)]);
  return some;
}

}  // namespace

std::vector<std::vector<double>> startsOf(const Objective& objective, size_t count) {
  assert(objective.conditions() == 1);
  if (objective.size() == 0) return {{}};
  const SigmoidShape& shape = objective.shape();
  const PreparedBlocks& blocks = objective.blocks(0);
  const std::vector<size_t> at = anchors(blocks);
  const int thresholdPlace = objective.place(0, FitParameter::Threshold);
  const int widthPlace = objective.place(0, FitParameter::Width);
  std::vector<double> x(objective.size(), 0.0);
  const AxisValues fixed = objective.valuesOf(0, x.data());

  std::vector<double> widths{fixed[indexOf(FitParameter::Width)]};
  if (widthPlace >= 0) {
    const FreeParameter& free = objective.free()[static_cast<size_t>(widthPlace)];
    widths.clear();
    for (const double logWidth : evenly(free.low, free.high, 9)) widths.push_back(std::exp(logWidth));
  }
  const std::vector<double> lapses =
      candidates(objective, FitParameter::Lapse, {0.004, 0.05, 0.2}, fixed[indexOf(FitParameter::Lapse)]);
  const std::vector<double> guesses =
      candidates(objective, FitParameter::Guess, {0.01, 0.1, 0.3}, fixed[indexOf(FitParameter::Guess)]);
  const std::vector<double> etas =
      candidates(objective, FitParameter::Eta, {0.02, 0.25}, fixed[indexOf(FitParameter::Eta)]);

  std::vector<Start> starts;
  const auto set = [&](FitParameter parameter, double value) {
    if (const int place = objective.place(0, parameter); place >= 0) x[static_cast<size_t>(place)] = value;
  };
  for (const double width : widths) {
    set(FitParameter::Width, std::log(width));
    for (const double lapse : lapses) {
      set(FitParameter::Lapse, lapse);
      for (const double guess : guesses) {
        set(FitParameter::Guess, guess);
        const double foot = objective.settings().task.kind == FitTask::Kind::EqualAsymptotes ? lapse : guess;
        std::vector<double> thresholds{fixed[indexOf(FitParameter::Threshold)]};
        if (thresholdPlace >= 0) {
          const FreeParameter& free = objective.free()[static_cast<size_t>(thresholdPlace)];
          thresholds = evenly(free.low, free.high, 9);
          for (const size_t i : at) {
            const double n = static_cast<double>(blocks.trials[i]);
            const double p = (static_cast<double>(blocks.correct[i]) + 0.25) / (n + 0.5);
            const double f = std::clamp((p - foot) / (1.0 - foot - lapse), 0.02, 0.98);
            const double z = standardInverse(shape.family, f);
            const double t = blocks.u[i] - (z - shape.zAtThreshold) * width / shape.zWidth;
            if (t > free.low && t < free.high) thresholds.push_back(t);
          }
        }
        for (const double threshold : thresholds) {
          set(FitParameter::Threshold, threshold);
          for (const double eta : etas) {
            set(FitParameter::Eta, eta);
            const double value = objective.evaluate(x.data(), nullptr);
            if (std::isfinite(value)) starts.push_back({x, value, threshold, width});
          }
        }
      }
    }
  }
  std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) {
    return a.value != b.value ? a.value < b.value : a.x < b.x;
  });
  std::vector<Start> chosen;
  for (const Start& start : starts) {
    if (chosen.size() == count) break;
    const bool near = std::any_of(chosen.begin(), chosen.end(), [&](const Start& other) {
      return std::abs(std::log(start.width / other.width)) < 1.5 &&
             std::abs(start.u - other.u) < 0.5 * std::max(start.width, other.width);
    });
    if (!near) chosen.push_back(start);
  }
  std::vector<std::vector<double>> points;
  for (Start& start : chosen) points.push_back(std::move(start.x));
  return points;
}

}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "analysis/output/text_output.h"
#include "analysis/sweep/chart.h"

namespace limen::analysis {
namespace {

constexpr double kLeastLogRatio = 1.1;  // equal values still get an axis
constexpr size_t kFewTicks = 3;
constexpr double kPadding = 0.06;  // share of the axis left free at each end

void addLogTicks(ChartAxis& axis, double low) {
  const double decades = std::log10(axis.high / low);
  const int step = std::max(1, static_cast<int>(std::ceil(decades / 7.0)));
  const int first = static_cast<int>(std::floor(std::log10(low)));
  const int last = static_cast<int>(std::ceil(std::log10(axis.high)));
  for (int power = first; power <= last; ++power)
    for (int digit = 1; digit < 10; ++digit) {
      const double value = digit * std::pow(10.0, power);
      if (value < low || value > axis.high) continue;
      const bool labelled = decades < 2.2 ? digit == 1 || digit == 2 || digit == 5
                                          : digit == 1 && ((power % step) + step) % step == 0;
      if (labelled)
        axis.ticks.emplace_back(formatNumber(value), value);
      else if (step == 1)
        axis.minorTicks.push_back(value);
    }
  if (axis.ticks.size() >= kFewTicks || decades > 1.0) return;
  // Of less than a decade even steps say more.
  axis.ticks.clear();
  axis.minorTicks.clear();
  for (const double level : roundLevels(low, axis.high, 6))
    axis.ticks.emplace_back(formatNumber(level), level);
}

double step125(double width) {
  const double power = std::pow(10.0, std::floor(std::log10(width)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (power * factor >= width * (1.0 - 1e-9)) return power * factor;
  return power * 10.0;
}

}  // namespace

std::vector<double> roundLevels(double low, double high, int steps) {
  std::vector<double> levels;
  if (!(low < high) || !std::isfinite(low) || !std::isfinite(high)) return levels;
  const double step = step125((high - low) / steps);
  for (double multiple = std::ceil(low / step); multiple * step <= high; ++multiple)
    levels.push_back(multiple * step);
  return levels;
}

double ChartAxis::length() const { return logarithmic ? std::log(high / low) : high - low; }

double ChartAxis::place(double value) const {
  if (foot && (std::isinf(value) || (logarithmic && value <= 0.0))) return *foot;
  return value;
}

ChartAxis makeChartAxis(const std::vector<double>& values, bool linear) {
  ChartAxis axis;
  axis.logarithmic = !linear;
  double low = INFINITY, high = -INFINITY;
  bool needsFoot = false;
  for (const double value : values) {
    const bool fits = std::isfinite(value) && (linear || value > 0.0);
    needsFoot = needsFoot || !fits;
    if (!fits) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) low = high = 1.0;

  if (linear) {
    const double span = std::max(high - low, std::max(std::abs(high) * 1e-3, 1e-12));
    axis.low = low - kPadding * span;
    axis.high = high + kPadding * span;
    for (const double level : roundLevels(axis.low, axis.high))
      axis.ticks.emplace_back(formatNumber(level), level);
    if (needsFoot) {
      axis.foot = axis.high + 0.12 * span;
      axis.high += 0.2 * span;
      axis.ticks.emplace_back("∞", *axis.foot);
    }
    return axis;
  }

  const double widen = std::sqrt(std::max(1.0, kLeastLogRatio / (high / low)));
  low /= widen;
  high *= widen;
  const double padding = std::pow(high / low, kPadding);
  axis.low = low / padding;
  axis.high = high * padding;
  addLogTicks(axis, axis.low);
  if (needsFoot) {
    const double gap = std::pow(high / low, 0.12);
    axis.foot = axis.low / gap;
    axis.low = *axis.foot / padding;
    axis.ticks.emplace_back("0", *axis.foot);
  }
  return axis;
}

}  // namespace limen::analysis

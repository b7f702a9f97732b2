// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "analysis/sweep/chart.h"
#include "analysis/output/text_output.h"
#include "analysis/sweep/trade_off.h"

namespace limen::analysis {
namespace {

constexpr double kLeastLogRatio = 4.0;  // so that at least two labelled ticks are in sight
constexpr double kPadding = 0.06;       // share of the axis left free at each end

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
}

}  // namespace

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
    for (const double level : roundLevels(axis.low, axis.high, false))
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

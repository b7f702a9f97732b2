// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/psychometric/prior.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "analysis/psychometric/likelihood.h"

namespace limen::analysis {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kBetaExponent = 9.0;  // of Beta(1, 10)

/// ln of (1 + cos(pi s))/2, 0 <= s <= 1: from 1 down to 0. `scale` = ds/dvalue.
LogPrior cosineFall(double s, double scale) {
  if (s <= 0.0) return {};
  if (s >= 1.0) return {-std::numeric_limits<double>::infinity(), 0.0};
  // (1 + cos a)/2 = cos^2(a/2)
  const double half = kPi / 2.0 * s;
  return {2.0 * std::log(std::cos(half)), -kPi * std::tan(half) * scale};
}

}  // namespace

LevelSpread spreadOf(std::vector<double> u, const FitSettings& settings) {
  std::erase_if(u, [](double value) { return !std::isfinite(value); });
  std::sort(u.begin(), u.end());
  LevelSpread spread;
  if (!u.empty()) spread = {u.front(), u.back(), 0.0};
  if (settings.range) {
    const SigmoidShape shape(settings);
    spread.low = shape.onAxis((*settings.range)[settings.falling ? 1 : 0]);
    spread.high = shape.onAxis((*settings.range)[settings.falling ? 0 : 1]);
  }
  spread.spacing = spread.range();
  for (size_t i = 1; i < u.size(); ++i)
    if (u[i] > u[i - 1]) spread.spacing = std::min(spread.spacing, u[i] - u[i - 1]);
  return spread;
}

LogPrior logPrior(FitParameter parameter, double value, const LevelSpread& spread) {
  switch (parameter) {
    case FitParameter::Threshold: {
      const double half = spread.range() / 2.0;
      return value < spread.low ? cosineFall((spread.low - value) / half, -1.0 / half)
                                : cosineFall((value - spread.high) / half, 1.0 / half);
    }
    case FitParameter::Width: {
      const LogPrior low = cosineFall(2.0 - value / spread.spacing, -1.0 / spread.spacing);
      const LogPrior high =
          cosineFall((value - spread.range()) / (2.0 * spread.range()), 0.5 / spread.range());
      return {low.value + high.value, low.slope + high.slope};
    }
    default:
      return {kBetaExponent * std::log1p(-value), -kBetaExponent / (1.0 - value)};
  }
}

std::string priorText(FitParameter parameter, const LevelSpread& own, bool falling) {
  LevelSpread spread = own;
  if (falling) spread.low = -own.high, spread.high = -own.low;
  const double half = spread.range() / 2.0;
  switch (parameter) {
    case FitParameter::Threshold:
      return fmt::format("uniform from {:.6g} to {:.6g} on the axis, cosine falls to 0 at {:.6g} and {:.6g}",
                         spread.low, spread.high, spread.low - half, spread.high + half);
    case FitParameter::Width:
      return fmt::format(
          "cosine rise from 0 at {:.6g} to 1 at {:.6g}, cosine fall from 1 at {:.6g} to 0 at {:.6g}",
          spread.spacing, 2.0 * spread.spacing, spread.range(), 3.0 * spread.range());
    default:
      return "Beta(1, 10)";
  }
}

}  // namespace limen::analysis

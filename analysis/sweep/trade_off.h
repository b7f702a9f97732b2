// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace limen::analysis {

/// Indices of the points that no other point beats: smaller is better in both, in order of growing first
/// value. Of equal points all stay.
std::vector<size_t> paretoFront(const std::vector<std::pair<double, double>>& points);

// What a report says of a trade-off between cost and error. docs/analyse.md, "What the report says", states
// the rules in words.

/// Error levels of a verdict, as multiples of the least error.
inline constexpr std::array kErrorLevels = {1.0, 1.1, 1.5, 2.0};
/// A setting is worth a higher cost if its error is lower by this share at least ...
inline constexpr double kLeastGain = 0.05;
/// ... and by this share for each doubling of the cost. Four samples for one halve the error of Monte Carlo
/// integration, 29 % a doubling: this asks for about a third of that.
inline constexpr double kGainPerDoubling = 0.1;
/// Distance of a knee below the line between the ends of the front, each axis logarithmic and scaled to 1.
inline constexpr double kLeastKnee = 0.1;

/// A setting: what it costs, with the interval of that (of no width where the cost is exact), and its error.
struct TradeOffPoint {
  double cost = 0.0, costLow = 0.0, costHigh = 0.0;
  double error = 0.0;  ///< at least 0, less is better; may be infinite
};

/// Indices are those of the points.
struct TradeOffVerdict {
  struct Level {
    double first = 1.0, last = 1.0;  ///< kErrorLevels that name the same settings
    size_t cheapest = 0;
    std::vector<size_t> ties;  ///< within the level too, at a cost not told apart; in order of cost
  };
  std::vector<Level> levels;   ///< from the least error up; empty without points
  std::vector<size_t> worth;   ///< settings worth their cost, from cheap to exact
  std::optional<size_t> knee;  ///< one of these
  /// By point: another setting is surely no worse in either, by intervals and noise, and surely better in
  /// one.
  std::vector<bool> beaten;
};

/// `noise`: errors that differ by no more are not told apart.
TradeOffVerdict weigh(const std::vector<TradeOffPoint>& points, double noise);

}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
// Interval arithmetic in double precision. Bounds are moved outwards after each operation by more than it may
// round, so that the exact result lies between them.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace limen::surfaces {

struct Interval {
  double low = 0.0, high = 0.0;

  static Interval around(double value, double radius = 0.0) {
    return widened(value - radius, value + radius);
  }
  static Interval widened(double low, double high) {
    // Twice half a unit in the last place; the second term is for results near zero.
    constexpr double kUnit = std::numeric_limits<double>::epsilon();
    constexpr double kTiny = 1e-300;
    return {low - (kUnit * std::abs(low) + kTiny), high + (kUnit * std::abs(high) + kTiny)};
  }

  double middle() const { return 0.5 * (low + high); }
  /// Largest absolute value.
  double size() const { return std::max(std::abs(low), std::abs(high)); }
  bool contains(double value) const { return low <= value && value <= high; }

  friend Interval operator+(Interval a, Interval b) { return widened(a.low + b.low, a.high + b.high); }
  friend Interval operator-(Interval a, Interval b) { return widened(a.low - b.high, a.high - b.low); }
  friend Interval operator*(Interval a, double b) {
    return b < 0.0 ? widened(a.high * b, a.low * b) : widened(a.low * b, a.high * b);
  }
};

}  // namespace limen::surfaces

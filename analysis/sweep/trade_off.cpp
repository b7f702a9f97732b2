// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/trade_off.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace limen::analysis {
namespace {

/// Compares settings as far as the intervals of cost and the noise of errors allow.
class Weighing {
 public:
  Weighing(const std::vector<TradeOffPoint>& points, double noise)
      : points_(points), noise_(noise), byCost_(points.size()) {
    std::iota(byCost_.begin(), byCost_.end(), size_t{0});
    std::stable_sort(byCost_.begin(), byCost_.end(), [&](size_t a, size_t b) {
      return std::pair(points[a].cost, points[a].error) < std::pair(points[b].cost, points[b].error);
    });
  }

  TradeOffVerdict verdict() const {
    TradeOffVerdict out;
    if (points_.empty()) return out;
    for (const double factor : kErrorLevels) {
      TradeOffVerdict::Level level = levelAt(factor);
      if (!out.levels.empty() && out.levels.back().cheapest == level.cheapest) {
        out.levels.back().last = factor;  // ties of the tightest level are within all of them
      } else {
        out.levels.push_back(std::move(level));
      }
    }
    out.worth = worthTheirCost();
    out.knee = kneeOf(out.worth);
    for (const TradeOffPoint& point : points_) out.beaten.push_back(isBeaten(point));
    return out;
  }

 private:
  TradeOffVerdict::Level levelAt(double factor) const {
    double least = INFINITY;
    for (const TradeOffPoint& point : points_) least = std::min(least, point.error);
    TradeOffVerdict::Level level{factor, factor, points_.size(), {}};
    for (const size_t index : byCost_) {
      const TradeOffPoint& point = points_[index];
      if (!(point.error <= factor * least + noise_)) continue;
      if (level.cheapest == points_.size())
        level.cheapest = index;
      else if (point.costLow <= points_[level.cheapest].costHigh)
        level.ties.push_back(index);
    }
    return level;
  }

  bool gains(const TradeOffPoint& from, const TradeOffPoint& to) const {
    if (from.error - to.error <= noise_ || to.error > (1.0 - kLeastGain) * from.error) return false;
    // At no cost that could be told apart, or from none, which has no doublings.
    if (to.costLow <= from.costHigh || from.cost <= 0.0) return true;
    const double doublings = std::log2(to.cost / from.cost);
    return to.error <= std::pow(1.0 - kGainPerDoubling, doublings) * from.error;
  }

  std::vector<size_t> worthTheirCost() const {
    std::vector<size_t> worth;
    double anchorHigh = 0.0;  // of the cheapest of those whose place the last one took
    for (const size_t index : byCost_) {
      const TradeOffPoint& point = points_[index];
      if (!worth.empty() && !gains(points_[worth.back()], point)) continue;
      // A chain of overlapping intervals must not walk away from where it began.
      if (!worth.empty() && point.costLow <= anchorHigh) {
        worth.back() = index;
        continue;
      }
      worth.push_back(index);
      anchorHigh = point.costHigh;
    }
    return worth;
  }

  /// Where the front lies farthest below the straight line between its ends (Satopaa, Albrecht, Irwin and
  /// Raghavan 2011), in logarithms, since times and errors compare by ratios.
  std::optional<size_t> kneeOf(const std::vector<size_t>& front) const {
    std::vector<size_t> shown;
    for (const size_t index : front)
      if (points_[index].error > 0.0 && std::isfinite(points_[index].error) && points_[index].cost > 0.0)
        shown.push_back(index);
    if (shown.size() < 3) return std::nullopt;
    const TradeOffPoint &cheap = points_[shown.front()], &exact = points_[shown.back()];
    std::optional<size_t> knee;
    double farthest = kLeastKnee;
    for (const size_t index : shown) {
      const TradeOffPoint& point = points_[index];
      const double along = std::log(point.cost / cheap.cost) / std::log(exact.cost / cheap.cost);
      const double up = std::log(point.error / exact.error) / std::log(cheap.error / exact.error);
      const double below = (1.0 - along - up) / std::sqrt(2.0);
      if (!(below >= farthest)) continue;
      farthest = below;
      knee = index;
    }
    return knee;
  }

  bool isBeaten(const TradeOffPoint& point) const {
    return std::any_of(points_.begin(), points_.end(), [&](const TradeOffPoint& other) {
      const bool clearlyCheaper = other.costHigh < point.costLow;
      const bool clearlyBetter = point.error - other.error > noise_;
      return other.costHigh <= point.costLow && other.error + noise_ <= point.error &&
             (clearlyCheaper || clearlyBetter);
    });
  }

  const std::vector<TradeOffPoint>& points_;
  double noise_;
  std::vector<size_t> byCost_;
};

}  // namespace

std::vector<size_t> paretoFront(const std::vector<std::pair<double, double>>& points) {
  std::vector<size_t> order(points.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return points[a] < points[b]; });
  std::vector<size_t> front;
  for (const size_t index : order) {
    if (front.empty() || points[index].second < points[front.back()].second ||
        points[index] == points[front.back()])
      front.push_back(index);
  }
  return front;
}

TradeOffVerdict weigh(const std::vector<TradeOffPoint>& points, double noise) {
  return Weighing(points, noise).verdict();
}

}  // namespace limen::analysis

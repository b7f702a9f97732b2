// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/trade_off.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace limen::analysis {
namespace {

constexpr size_t kMostLevels = 5;

double step125(double width) {
  const double power = std::pow(10.0, std::floor(std::log10(width)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (power * factor >= width * (1.0 - 1e-9)) return power * factor;
  return power * 10.0;
}

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

std::vector<double> roundLevels(double low, double high, bool logarithmic) {
  std::vector<double> levels;
  if (!(low < high) || !std::isfinite(low) || !std::isfinite(high)) return levels;
  if (logarithmic && low > 0.0 && high / low >= 10.0) {
    const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
    const bool triples = high / low < 1000.0;
    for (int power = first - 1; power <= last; ++power)
      for (const double factor : {1.0, 3.0}) {
        const double level = factor * std::pow(10.0, power);
        if ((factor == 1.0 || triples) && level >= low && level <= high) levels.push_back(level);
      }
  } else {
    const double step = step125((high - low) / 4.0);
    for (double multiple = std::ceil(low / step); multiple * step <= high; ++multiple)
      levels.push_back(multiple * step);
  }
  // The tight end is where techniques differ.
  if (levels.size() > kMostLevels) {
    std::vector<double> thinned;
    for (size_t i = 0; i < kMostLevels; ++i)
      thinned.push_back(levels[i * (levels.size() - 1) / (kMostLevels - 1)]);
    levels = thinned;
  }
  return levels;
}

}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

namespace limen::analysis {
namespace {

constexpr int kResamples = 2000;
constexpr size_t kFewestRounds = 3;
constexpr size_t kMostLevels = 5;

double medianOf(std::vector<double>& values) {
  const size_t middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(middle), values.end());
  if (values.size() % 2 == 1) return values[middle];
  return (values[middle] + *std::max_element(values.begin(), values.begin() + static_cast<long>(middle))) /
         2.0;
}

// std::uniform_int_distribution differs between standard libraries; this does not. The bias is below 2^-32.
size_t draw(std::mt19937_64& random, size_t count) {
  return static_cast<size_t>((random() >> 32) * count >> 32);
}

double step125(double width) {
  const double power = std::pow(10.0, std::floor(std::log10(width)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (power * factor >= width * (1.0 - 1e-9)) return power * factor;
  return power * 10.0;
}

}  // namespace

double quantile(std::vector<double> values, double q) {
  assert(!values.empty() && q >= 0.0 && q <= 1.0);
  std::sort(values.begin(), values.end());
  const double position = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<size_t>(position);
  const size_t above = std::min(below + 1, values.size() - 1);
  return std::lerp(values[below], values[above], position - static_cast<double>(below));
}

Summary summarise(const std::vector<double>& values) {
  assert(!values.empty());
  Summary summary;
  summary.n = values.size();
  summary.minimum = *std::min_element(values.begin(), values.end());
  summary.median = quantile(values, 0.5);
  summary.p95 = quantile(values, 0.95);
  const auto n = static_cast<double>(values.size());
  summary.mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - summary.mean) * (value - summary.mean);
  if (values.size() > 1) summary.standardDeviation = std::sqrt(squares / (n - 1.0));
  return summary;
}

Interval bootstrapMedian(const std::vector<double>& values, const std::vector<int>& rounds, uint64_t seed) {
  assert(!values.empty() && rounds.size() == values.size());
  std::map<int, std::vector<double>> byRound;
  for (size_t i = 0; i < values.size(); ++i) byRound[rounds[i]].push_back(values[i]);
  std::vector<std::vector<double>> blocks;
  for (auto& [round, block] : byRound) blocks.push_back(std::move(block));

  Interval interval;
  interval.byRounds = blocks.size() >= kFewestRounds;
  if (!interval.byRounds) {
    blocks.clear();
    for (const double value : values) blocks.push_back({value});
  }
  std::mt19937_64 random(seed);
  std::vector<double> medians, sample;
  medians.reserve(kResamples);
  for (int resample = 0; resample < kResamples; ++resample) {
    sample.clear();
    for (size_t i = 0; i < blocks.size(); ++i) {
      const std::vector<double>& block = blocks[draw(random, blocks.size())];
      sample.insert(sample.end(), block.begin(), block.end());
    }
    medians.push_back(medianOf(sample));
  }
  interval.low = quantile(medians, 0.025);
  interval.high = quantile(medians, 0.975);
  return interval;
}

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

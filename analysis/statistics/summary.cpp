// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/summary.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "analysis/statistics/detail/draw.h"

namespace limen::analysis {
namespace {

constexpr int kResamples = 2000;
constexpr size_t kFewestRounds = 3;

double medianOf(std::vector<double>& values) {
  const size_t middle = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + static_cast<long>(middle), values.end());
  if (values.size() % 2 == 1) return values[middle];
  return (values[middle] + *std::max_element(values.begin(), values.begin() + static_cast<long>(middle))) /
         2.0;
}

}  // namespace

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  return sortedQuantile(values, q);
}

double sortedQuantile(const std::vector<double>& sorted, double q) {
  assert(!sorted.empty() && q >= 0.0 && q <= 1.0);
  const double position = q * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<size_t>(position);
  const size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
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

MedianInterval bootstrapMedian(const std::vector<double>& values, const std::vector<int>& rounds,
                               uint64_t seed) {
  assert(!values.empty() && rounds.size() == values.size());
  std::map<int, std::vector<double>> byRound;
  for (size_t i = 0; i < values.size(); ++i) byRound[rounds[i]].push_back(values[i]);
  std::vector<std::vector<double>> blocks;
  for (auto& [round, block] : byRound) blocks.push_back(std::move(block));

  MedianInterval interval;
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
      const std::vector<double>& block = blocks[drawIndex(random, blocks.size())];
      sample.insert(sample.end(), block.begin(), block.end());
    }
    medians.push_back(medianOf(sample));
  }
  interval.low = quantile(medians, 0.025);
  interval.high = quantile(medians, 0.975);
  return interval;
}

}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/crossing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>

namespace limen::analysis {
namespace {

std::vector<double> meanOf(const std::vector<std::vector<double>>& curves,
                           const std::vector<size_t>& chosen) {
  std::vector<double> out(curves[0].size(), 0.0);
  for (const size_t index : chosen)
    for (size_t i = 0; i < out.size(); ++i) out[i] += curves[index][i];
  for (double& value : out) value /= static_cast<double>(chosen.size());
  return out;
}

/// The order statistic nearest to a share: crossings beyond the measured range have no distance to
/// interpolate.
const Crossing& atShare(const std::vector<Crossing>& sorted, double share, bool up) {
  const double position = share * static_cast<double>(sorted.size() - 1);
  const double rounded = up ? std::ceil(position) : std::floor(position);
  return sorted[static_cast<size_t>(std::clamp(rounded, 0.0, static_cast<double>(sorted.size() - 1)))];
}

}  // namespace

std::vector<double> fitNonIncreasing(const std::vector<double>& values) {
  struct Block {
    double sum;
    size_t count;
    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Block> blocks;
  for (const double value : values) {
    blocks.push_back({value, 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() < blocks.back().mean()) {
      blocks[blocks.size() - 2].sum += blocks.back().sum;
      blocks[blocks.size() - 2].count += blocks.back().count;
      blocks.pop_back();
    }
  }
  std::vector<double> out;
  for (const Block& block : blocks) out.insert(out.end(), block.count, block.mean());
  return out;
}

Crossing findCrossing(const std::vector<double>& x, const std::vector<double>& y, double level) {
  assert(!x.empty() && x.size() == y.size());
  const std::vector<double> fit = fitNonIncreasing(y);
  if (fit.front() <= level) return {Crossing::Place::AtOrBelowFirst, x.front()};
  for (size_t i = 1; i < fit.size(); ++i) {
    if (fit[i] > level) continue;
    const double share = (fit[i - 1] - level) / (fit[i - 1] - fit[i]);
    return {Crossing::Place::Within, x[i - 1] * std::pow(x[i] / x[i - 1], share)};
  }
  return {Crossing::Place::BeyondLast, x.back()};
}

bool operator<(const Crossing& a, const Crossing& b) {
  const auto rank = [](const Crossing& crossing) {
    return crossing.place == Crossing::Place::AtOrBelowFirst ? 0
           : crossing.place == Crossing::Place::Within       ? 1
                                                             : 2;
  };
  return rank(a) != rank(b) ? rank(a) < rank(b) : a.x < b.x;
}

CrossingEstimate estimateCrossing(const std::vector<double>& x,
                                  const std::vector<std::vector<double>>& replicates, double level,
                                  double confidence, int resamples, uint64_t seed) {
  assert(!replicates.empty());
  std::vector<size_t> chosen(replicates.size());
  for (size_t i = 0; i < chosen.size(); ++i) chosen[i] = i;
  CrossingEstimate out;
  out.ofMean = findCrossing(x, meanOf(replicates, chosen), level);
  std::vector<Crossing> each;
  for (const std::vector<double>& curve : replicates) each.push_back(findCrossing(x, curve, level));
  out.farthest = *std::max_element(each.begin(), each.end());
  if (replicates.size() < 2) return out;

  std::mt19937_64 engine(seed);
  std::vector<Crossing> bootstrap;
  for (int i = 0; i < resamples; ++i) {
    // The remainder's bias is below 1e-17 for so few replicates; std distributions differ between libraries.
    for (size_t& index : chosen) index = engine() % replicates.size();
    bootstrap.push_back(findCrossing(x, meanOf(replicates, chosen), level));
  }
  std::sort(bootstrap.begin(), bootstrap.end());
  out.low = atShare(bootstrap, 0.5 * (1.0 - confidence), false);
  out.high = atShare(bootstrap, 0.5 * (1.0 + confidence), true);
  return out;
}

}  // namespace limen::analysis

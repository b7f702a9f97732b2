// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/rank_tests.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "analysis/statistics/detail/check.h"
#include "analysis/statistics/detail/ranks.h"
#include "analysis/statistics/distributions.h"
#include "experiments/base/error.h"

namespace limen::analysis {
namespace {

constexpr size_t kExactPairs = 50;
constexpr double kRounding = 4.0 * std::numeric_limits<double>::epsilon();  ///< of the largest value

/// Sum of t^3 - t over groups of ties.
double tieSum(const Ranks& ranks) {
  double sum = 0.0;
  for (const double t : ranks.tieSizes) sum += t * (t - 1.0) * (t + 1.0);
  return sum;
}

/// Values that follow one another within `rounding` become the smallest of them.
void joinNeighbours(std::vector<double>& values, double rounding) {
  std::vector<size_t> order(values.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return values[a] < values[b]; });
  double joined = -std::numeric_limits<double>::infinity(), previous = joined;
  for (const size_t i : order) {
    const double value = values[i];
    if (value - previous > rounding) joined = value;
    previous = value;
    values[i] = joined;
  }
}

/// first - second, where those that differ by rounding only are made equal in size: 3.1 - 2.2 and 2.8 - 3.7
/// tie on paper but not in binary.
std::vector<double> differencesOf(const std::vector<double>& first, const std::vector<double>& second) {
  requireSameLength(first.size(), "first", second.size(), "second");
  requireAtLeast(first.size(), 1, "first");
  requireFinite(first, "first");
  requireFinite(second, "second");
  std::vector<double> differences;
  double largest = 0.0;
  for (size_t i = 0; i < first.size(); ++i) {
    differences.push_back(first[i] - second[i]);
    largest = std::max({largest, std::abs(first[i]), std::abs(second[i])});
  }
  // Beside a size of 0, so that what rounding leaves of equal pairs becomes 0.
  std::vector<double> sizes = {0.0};
  for (const double difference : differences) sizes.push_back(std::abs(difference));
  joinNeighbours(sizes, kRounding * largest);
  for (size_t i = 0; i < differences.size(); ++i)
    differences[i] = std::copysign(sizes[i + 1], differences[i]);
  return differences;
}

/// Twice the smaller tail of V over all signs of the ranks 1 .. n.
double exactSignedRank(size_t n, double v) {
  const size_t total = n * (n + 1) / 2;
  std::vector<double> chance(total + 1, 0.0);
  chance[0] = 1.0;
  size_t reach = 0;
  for (size_t rank = 1; rank <= n; ++rank) {
    reach += rank;
    for (size_t sum = reach + 1; sum-- > 0;)
      chance[sum] = 0.5 * (chance[sum] + (sum >= rank ? chance[sum - rank] : 0.0));
  }
  const auto tail = static_cast<size_t>(std::min(v, static_cast<double>(total) - v));
  double p = 0.0;
  for (size_t sum = 0; sum <= tail; ++sum) p += chance[sum];
  return std::min(1.0, 2.0 * p);
}

}  // namespace

FriedmanTest friedmanTest(const std::vector<double>& values, size_t subjects, size_t treatments) {
  if (subjects < 2) throw Error(fmt::format("{} subjects, needs at least 2", subjects), "subjects");
  if (treatments < 2) throw Error(fmt::format("{} treatments, needs at least 2", treatments), "treatments");
  if (values.size() % treatments != 0 || values.size() / treatments != subjects)
    throw Error(
        fmt::format("{} values for {} subjects and {} treatments", values.size(), subjects, treatments),
        indexed("values", values.size()), "give one value for each subject and treatment");
  requireFinite(values, "values");

  FriedmanTest test;
  test.subjects = subjects;
  test.treatments = treatments;
  test.meanRanks.assign(treatments, 0.0);
  const auto n = static_cast<double>(subjects), k = static_cast<double>(treatments);
  double ties = 0.0;
  for (size_t s = 0; s < subjects; ++s) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(s * treatments);
    std::vector<double> row(first, first + static_cast<std::ptrdiff_t>(treatments));
    double largest = 0.0;
    for (const double value : row) largest = std::max(largest, std::abs(value));
    joinNeighbours(row, kRounding * largest);
    const Ranks ranks = rank(row);
    ties += tieSum(ranks);
    for (size_t j = 0; j < treatments; ++j) test.meanRanks[j] += ranks.ranks[j];
  }
  double squares = 0.0;
  for (double& sum : test.meanRanks) {
    squares += std::pow(sum - n * (k + 1.0) / 2.0, 2.0);
    sum /= n;
  }
  const double scale = n * k * (k + 1.0) - ties / (k - 1.0);
  if (scale <= 0.0) return test;
  test.chiSquared = 12.0 * squares / scale;
  test.p = chiSquaredUpper(*test.chiSquared, k - 1.0);
  test.kendallW = *test.chiSquared / (n * (k - 1.0));
  const double rest = n * (k - 1.0) - *test.chiSquared;
  if (rest <= 1e-12 * n * k) {
    test.f = std::numeric_limits<double>::infinity();
    test.fP = 0.0;
  } else {
    test.f = (n - 1.0) * *test.chiSquared / rest;
    test.fP = fUpper(*test.f, k - 1.0, (k - 1.0) * (n - 1.0));
  }
  return test;
}

SignedRankTest signedRankTest(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<double> differences = differencesOf(first, second);
  SignedRankTest test;
  std::erase(differences, 0.0);
  test.pairs = differences.size();
  test.zeros = first.size() - differences.size();
  if (differences.empty()) return test;

  std::vector<double> sizes;
  for (const double d : differences) sizes.push_back(std::abs(d));
  const Ranks ranks = rank(sizes);
  for (size_t i = 0; i < differences.size(); ++i)
    (differences[i] > 0.0 ? test.positiveRanks : test.negativeRanks) += ranks.ranks[i];
  const auto n = static_cast<double>(test.pairs);
  const double total = n * (n + 1.0) / 2.0;
  test.rankBiserial = (test.positiveRanks - test.negativeRanks) / total;
  test.exact = test.zeros == 0 && ranks.tieSizes.size() == test.pairs && test.pairs <= kExactPairs;
  if (test.exact) {
    test.p = exactSignedRank(test.pairs, test.positiveRanks);
    return test;
  }
  const double variance = n * (n + 1.0) * (2.0 * n + 1.0) / 24.0 - tieSum(ranks) / 48.0;
  const double distance = std::max(0.0, std::abs(test.positiveRanks - total / 2.0) - 0.5);
  test.p = normalTwoSided(distance / std::sqrt(variance));
  return test;
}

}  // namespace limen::analysis

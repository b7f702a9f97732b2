// SPDX-License-Identifier: BSD-3-Clause
#include "study/protocol/order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "study/protocol/design.h"

namespace limen::study {
namespace {

using psychometrics::Random;

/// Longest run of equal values, counted plainly.
int longestRun(const std::vector<size_t>& order, const std::vector<int>& values) {
  int longest = 0;
  for (size_t i = 0; i < order.size(); ++i) {
    size_t j = i;
    while (j < order.size() && values[order[j]] == values[order[i]]) ++j;
    longest = std::max(longest, static_cast<int>(j - i));
  }
  return longest;
}

bool allowed(const std::vector<size_t>& order, const std::vector<RunLimit>& limits) {
  return std::all_of(limits.begin(), limits.end(),
                     [&](const RunLimit& limit) { return longestRun(order, limit.values) <= limit.atMost; });
}

/// All allowed orders of at most seven items.
std::vector<std::vector<size_t>> allowedOrders(size_t items, const std::vector<RunLimit>& limits) {
  std::vector<size_t> order(items);
  std::iota(order.begin(), order.end(), size_t{0});
  std::vector<std::vector<size_t>> out;
  do {
    if (allowed(order, limits)) out.push_back(order);
  } while (std::next_permutation(order.begin(), order.end()));
  return out;
}

TEST(Order, FeasibilityIsThatOfTryingAllOrders) {
  Random random(1);
  int possible = 0, impossible = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const size_t items = 2 + random.below(5);
    std::vector<RunLimit> limits(1 + random.below(2));
    for (RunLimit& limit : limits) {
      limit.atMost = 1 + static_cast<int>(random.below(2));
      const uint64_t values = 1 + random.below(3);
      for (size_t i = 0; i < items; ++i) limit.values.push_back(static_cast<int>(random.below(values)));
    }
    const bool exists = !allowedOrders(items, limits).empty();
    ++(exists ? possible : impossible);
    EXPECT_EQ(feasibility(items, limits), exists ? Feasibility::Possible : Feasibility::Impossible);
    if (!exists) continue;
    const std::vector<size_t> order = limitedShuffle(items, limits, random);
    EXPECT_TRUE(allowed(order, limits));
    EXPECT_TRUE(std::is_permutation(order.begin(), order.end(), allowedOrders(items, {})[0].begin()));
  }
  EXPECT_GT(possible, 30);
  EXPECT_GT(impossible, 30);
}

TEST(Order, EveryAllowedOrderIsEquallyLikely) {
  const std::vector<RunLimit> limits = {{{0, 0, 0, 1, 1}, 2}};
  const auto all = allowedOrders(5, limits);
  std::map<std::vector<size_t>, int> counts;
  Random random(2);
  const int draws = 200 * static_cast<int>(all.size());
  for (int i = 0; i < draws; ++i) ++counts[limitedShuffle(5, limits, random)];
  ASSERT_EQ(counts.size(), all.size());
  // Chi square of n - 1 degrees of freedom: mean n - 1, variance 2 (n - 1); five standard deviations.
  double chiSquare = 0.0;
  for (const auto& [order, count] : counts) chiSquare += (count - 200.0) * (count - 200.0) / 200.0;
  const double freedom = static_cast<double>(all.size()) - 1.0;
  EXPECT_LT(chiSquare, freedom + 5.0 * std::sqrt(2.0 * freedom));
}

TEST(Order, ReachesNarrowLimits) {
  Random random(3);
  // Two values in strict turns: two orders of kinds out of C(60, 30).
  std::vector<int> halves(60);
  for (size_t i = 0; i < 30; ++i) halves[i] = 1;
  EXPECT_EQ(longestRun(limitedShuffle(60, {{halves, 1}}, random), halves), 1);
  // 41 of 61 with two in a row at most leave no slack: 2 (20 + 1) = 42.
  std::vector<int> uneven(61);
  for (size_t i = 0; i < 41; ++i) uneven[i] = 1;
  EXPECT_LE(longestRun(limitedShuffle(61, {{uneven, 2}}, random), uneven), 2);
  // Three limits at once on 2 x 3 x 2 kinds of 8.
  std::vector<RunLimit> limits = {{{}, 2}, {{}, 2}, {{}, 3}};
  for (int i = 0; i < 96; ++i) {
    limits[0].values.push_back(i % 2);
    limits[1].values.push_back(i / 2 % 3);
    limits[2].values.push_back(i / 6 % 2);
  }
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(allowed(limitedShuffle(96, limits, random), limits));
}

TEST(Order, LongOnesEndSoon) {
  // 20,000 items in strict turns: shuffles and swaps have no chance, and the search goes 20,000 deep.
  std::vector<int> halves(20000);
  for (size_t i = 0; i < 10000; ++i) halves[i] = 1;
  Random random(4);
  EXPECT_EQ(longestRun(limitedShuffle(20000, {{halves, 1}}, random), halves), 1);
}

TEST(Order, TellsWhatIsImpossible) {
  std::vector<int> uneven(10);
  for (size_t i = 0; i < 7; ++i) uneven[i] = 1;
  EXPECT_EQ(feasibility(10, {{uneven, 1}}), Feasibility::Impossible);  // 3 others make 4 gaps
  EXPECT_EQ(feasibility(10, {{uneven, 2}}), Feasibility::Possible);
  EXPECT_EQ(feasibility(0, {}), Feasibility::Possible);
  EXPECT_EQ(feasibility(3, {{{5, 5, 5}, 2}}), Feasibility::Impossible);
}

TEST(Order, WilliamsRowsBalanceWhatFollowsWhat) {
  for (int n = 2; n <= 9; ++n) {
    const int rows = n % 2 == 0 ? n : 2 * n;
    std::map<std::pair<int, int>, int> follows, places;
    for (int row = 0; row < rows; ++row) {
      const std::vector<int> order = williamsRow(n, row);
      ASSERT_EQ(order.size(), static_cast<size_t>(n));
      for (int i = 0; i < n; ++i) {
        ++places[{i, order[static_cast<size_t>(i)]}];
        if (i > 0) ++follows[{order[static_cast<size_t>(i - 1)], order[static_cast<size_t>(i)]}];
      }
    }
    for (int a = 0; a < n; ++a)
      for (int b = 0; b < n; ++b) {
        EXPECT_EQ((places[{a, b}]), rows / n) << n;
        EXPECT_EQ((follows[{a, b}]), a == b ? 0 : rows / n) << n;
      }
    EXPECT_EQ(williamsRow(n, rows + 1), williamsRow(n, 1));
  }
  EXPECT_EQ(williamsRow(1, 5), std::vector<int>{0});
}

TEST(Order, LatinRowsPutEachTreatmentInEachPlaceOnce) {
  for (int n = 1; n <= 7; ++n) {
    std::map<std::pair<int, int>, int> places;
    for (int row = 0; row < n; ++row)
      for (int i = 0; i < n; ++i) ++places[{i, latinRow(n, row)[static_cast<size_t>(i)]}];
    EXPECT_EQ(places.size(), static_cast<size_t>(n * n));
    EXPECT_EQ(latinRow(n, n), latinRow(n, 0));
  }
}

}  // namespace
}  // namespace limen::study

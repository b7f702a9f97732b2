// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/summary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>

#include "analysis/sweep/chart.h"
#include "analysis/sweep/trade_off.h"

namespace limen::analysis {
namespace {

using testing::ElementsAre;

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  // Position q (n - 1) among 1, 2, 3, 4: 0.5 * 3 = 1.5 -> 2.5; 0.95 * 3 = 2.85 -> 3.85.
  EXPECT_DOUBLE_EQ(quantile({4, 1, 3, 2}, 0.5), 2.5);
  EXPECT_NEAR(quantile({4, 1, 3, 2}, 0.95), 3.85, 1e-12);
  EXPECT_EQ(quantile({4, 1, 3, 2}, 0.0), 1.0);
  EXPECT_EQ(quantile({4, 1, 3, 2}, 1.0), 4.0);
}

TEST(Summary, MatchesTheTextbookExample) {
  // 2 4 4 4 5 5 7 9: mean 40 / 8 = 5, squares 9+1+1+1+0+0+4+16 = 32, SD sqrt(32 / 7); the 95th percentile
  // lies at 0.95 * 7 = 6.65, between 7 and 9: 8.3.
  const Summary summary = summarise({2, 4, 4, 4, 5, 5, 7, 9});
  EXPECT_EQ(summary.n, 8U);
  EXPECT_EQ(summary.minimum, 2.0);
  EXPECT_EQ(summary.median, 4.5);
  EXPECT_EQ(summary.mean, 5.0);
  EXPECT_NEAR(summary.p95, 8.3, 1e-12);
  EXPECT_NEAR(summary.standardDeviation, std::sqrt(32.0 / 7.0), 1e-12);
}

TEST(Summary, OfOneValueIsThatValue) {
  const Summary summary = summarise({3.5});
  EXPECT_EQ(summary.median, 3.5);
  EXPECT_EQ(summary.p95, 3.5);
  EXPECT_EQ(summary.standardDeviation, 0.0);
}

// P(bootstrap median of 1..n <= k), n odd: at least (n + 1) / 2 of n draws are <= k, each with probability k
// / n.
double medianAtMost(int k, int n) {
  const double p = static_cast<double>(k) / n;
  if (k >= n) return 1.0;
  double sum = 0.0;
  for (int j = (n + 1) / 2; j <= n; ++j)
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(j + 1) - std::lgamma(n - j + 1) + j * std::log(p) +
                    (n - j) * std::log1p(-p));
  return sum;
}

TEST(BootstrapMedian, OfFramesMatchesItsExactDistribution) {
  constexpr int kN = 25;
  std::vector<double> values;
  for (int i = 1; i <= kN; ++i) values.push_back(i);
  int low = 1, high = 1;
  while (medianAtMost(low, kN) < 0.025) ++low;
  while (medianAtMost(high, kN) < 0.975) ++high;
  const MedianInterval interval = bootstrapMedian(values, std::vector<int>(kN, 0));
  EXPECT_FALSE(interval.byRounds);
  // The exact quantile may sit on the edge between two order statistics, so one rank either way.
  EXPECT_NEAR(interval.low, low, 1.0);
  EXPECT_NEAR(interval.high, high, 1.0);
}

TEST(BootstrapMedian, DrawsWholeRoundsFromThreeOn) {
  std::vector<double> values;
  std::vector<int> threeRounds, twoRounds;
  for (int round = 0; round < 3; ++round)
    for (int frame = 0; frame < 100; ++frame) {
      values.push_back(round + 1.0);
      threeRounds.push_back(round);
      twoRounds.push_back(round % 2);
    }
  // Three draws of {1, 2, 3}: two or more are 1 with probability 7/27, far above 2.5 %; so also for 3.
  const MedianInterval rounds = bootstrapMedian(values, threeRounds);
  EXPECT_TRUE(rounds.byRounds);
  EXPECT_EQ(rounds.low, 1.0);
  EXPECT_EQ(rounds.high, 3.0);
  // Frame by frame the count of ones has mean 100 and SD 8: 150 of 300 never come.
  const MedianInterval frames = bootstrapMedian(values, twoRounds);
  EXPECT_FALSE(frames.byRounds);
  EXPECT_EQ(frames.low, 2.0);
  EXPECT_EQ(frames.high, 2.0);
}

TEST(BootstrapMedian, IsTheSameForTheSameSeedAndHoldsTheMedian) {
  std::mt19937 random(3);
  std::vector<double> values;
  for (int i = 0; i < 64; ++i) values.push_back(1.0 + static_cast<double>(random() % 1000) / 1000.0);
  const std::vector<int> rounds(64, 0);
  const MedianInterval first = bootstrapMedian(values, rounds, 7), again = bootstrapMedian(values, rounds, 7);
  EXPECT_EQ(first.low, again.low);
  EXPECT_EQ(first.high, again.high);
  EXPECT_LE(first.low, quantile(values, 0.5));
  EXPECT_GE(first.high, quantile(values, 0.5));
  EXPECT_LT(first.low, first.high);
}

TEST(BootstrapMedian, OfOneFrameIsAPoint) {
  const MedianInterval interval = bootstrapMedian({2.0}, {0});
  EXPECT_EQ(interval.low, 2.0);
  EXPECT_EQ(interval.high, 2.0);
}

TEST(ParetoFront, HoldsExactlyThePointsThatNothingBeats) {
  std::mt19937 random(11);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<std::pair<double, double>> points;
    for (int i = 0; i < 40; ++i) points.emplace_back(random() % 12, random() % 12);  // many ties
    std::set<size_t> expected;
    for (size_t i = 0; i < points.size(); ++i) {
      bool beaten = false;
      for (const auto& other : points)
        beaten = beaten ||
                 (other.first <= points[i].first && other.second <= points[i].second && other != points[i]);
      if (!beaten) expected.insert(i);
    }
    const std::vector<size_t> front = paretoFront(points);
    EXPECT_EQ(std::set<size_t>(front.begin(), front.end()), expected);
    EXPECT_EQ(front.size(), expected.size());
    for (size_t i = 1; i < front.size(); ++i) EXPECT_LE(points[front[i - 1]].first, points[front[i]].first);
  }
}

TEST(ParetoFront, OfNothingIsEmpty) { EXPECT_TRUE(paretoFront({}).empty()); }

TEST(RoundLevels, AreEvenSteps) {
  // A quarter of 25 is 6.25; the next of 1, 2, 5, 10 is 10.
  EXPECT_THAT(roundLevels(20.0, 45.0), ElementsAre(20.0, 30.0, 40.0));
  EXPECT_THAT(roundLevels(1.0, 3.0), ElementsAre(1.0, 1.5, 2.0, 2.5, 3.0));
}

TEST(RoundLevels, OfAPointAreNone) { EXPECT_TRUE(roundLevels(1.0, 1.0).empty()); }

}  // namespace
}  // namespace limen::analysis

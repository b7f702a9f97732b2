// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/sweep/crossing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace limen::analysis {
namespace {

using testing::ElementsAre;
using Place = Crossing::Place;

TEST(NonIncreasing, EqualsTheMinimaxFormula) {
  // Robertson, Wright and Dykstra 1988, theorem 1.4.4: the fit at i is the least over starts j <= i of the
  // largest over ends k >= i ... for falling fits: max and min change places.
  std::mt19937 engine(7);
  for (int round = 0; round < 50; ++round) {
    std::vector<double> values(1 + engine() % 9);
    for (double& value : values) value = static_cast<double>(engine() % 11);
    const std::vector<double> fit = fitNonIncreasing(values);
    for (size_t i = 0; i < values.size(); ++i) {
      double expected = 1e300;
      for (size_t j = 0; j <= i; ++j) {
        double largest = -1e300;
        for (size_t k = i; k < values.size(); ++k) {
          double sum = 0.0;
          for (size_t m = j; m <= k; ++m) sum += values[m];
          largest = std::max(largest, sum / static_cast<double>(k - j + 1));
        }
        expected = std::min(expected, largest);
      }
      EXPECT_NEAR(fit[i], expected, 1e-12);
    }
  }
  EXPECT_THAT(fitNonIncreasing({1.0, 3.0, 2.0}), ElementsAre(2.0, 2.0, 2.0));
}

TEST(Crossing, IsExactWhereTheCurveIsLinearInTheLogarithm) {
  // P = 1 - lg x falls to 0.25 at x = 10^0.75.
  const std::vector<double> x = {1.0, 2.0, 4.0, 10.0};
  std::vector<double> y;
  for (const double value : x) y.push_back(1.0 - std::log10(value));
  const Crossing crossing = findCrossing(x, y, 0.25);
  EXPECT_EQ(crossing.place, Place::Within);
  EXPECT_NEAR(crossing.x, std::pow(10.0, 0.75), 1e-12);
}

TEST(Crossing, SaysOnWhichSideOfTheMeasuredRangeItLies) {
  EXPECT_EQ(findCrossing({1, 2}, {0.4, 0.1}, 0.5).place, Place::AtOrBelowFirst);
  EXPECT_EQ(findCrossing({1, 2}, {0.5, 0.1}, 0.5).place, Place::AtOrBelowFirst);
  EXPECT_EQ(findCrossing({1, 2}, {0.9, 0.6}, 0.5).place, Place::BeyondLast);
  EXPECT_EQ(findCrossing({3}, {0.9}, 0.5).place, Place::BeyondLast);
  // A curve that rises again is not trusted where it dipped: pooled with 0.9 it is 0.6.
  EXPECT_EQ(findCrossing({1, 2, 4}, {0.8, 0.3, 0.9}, 0.5).place, Place::BeyondLast);
  EXPECT_TRUE(findCrossing({1, 2}, {0.4, 0.1}, 0.5) < findCrossing({1, 2}, {0.9, 0.1}, 0.5));
  EXPECT_TRUE(findCrossing({1, 2}, {0.9, 0.1}, 0.5) < findCrossing({1, 2}, {0.9, 0.6}, 0.5));
}

TEST(Crossing, OfEqualViewsHasAnIntervalOfNoWidth) {
  const std::vector<double> x = {1, 2, 4, 8}, y = {0.9, 0.6, 0.3, 0.1};
  const CrossingEstimate estimate = estimateCrossing(x, {y, y, y}, 0.5);
  EXPECT_DOUBLE_EQ(estimate.low->x, estimate.ofMean.x);
  EXPECT_DOUBLE_EQ(estimate.high->x, estimate.ofMean.x);
  EXPECT_DOUBLE_EQ(estimate.farthest.x, estimate.ofMean.x);
  EXPECT_FALSE(estimateCrossing(x, {y}, 0.5).low) << "one view says nothing of the others";
}

TEST(Crossing, IntervalCoversTheTruthAboutAsOftenAsItPromises) {
  // Views are logistic curves in lg x whose thresholds scatter symmetrically around lg 4; the mean curve of
  // all views then falls to 0.5 at x = 4 by symmetry. Percentile intervals from 12 views promise a little too
  // much: with 300 repetitions 95 % +- 1.3 % would be perfect, and 12 views are known to give about 92 %.
  std::vector<double> x;
  for (int i = 0; i <= 12; ++i) x.push_back(std::pow(2.0, 0.5 * i - 1.0));
  std::mt19937 engine(3);
  std::normal_distribution<double> scatter(0.0, 0.1);
  int covered = 0;
  for (int repetition = 0; repetition < 300; ++repetition) {
    std::vector<std::vector<double>> views;
    for (int view = 0; view < 12; ++view) {
      const double threshold = std::log10(4.0) + scatter(engine);
      std::vector<double> curve;
      for (const double value : x)
        curve.push_back(1.0 / (1.0 + std::exp((std::log10(value) - threshold) / 0.08)));
      views.push_back(std::move(curve));
    }
    const CrossingEstimate estimate = estimateCrossing(x, views, 0.5, 0.95, 400, 1 + repetition);
    covered += estimate.low->x <= 4.0 && 4.0 <= estimate.high->x;
  }
  EXPECT_GE(covered, 300 * 0.87);
  EXPECT_LE(covered, 300 * 0.985);
}

}  // namespace
}  // namespace limen::analysis

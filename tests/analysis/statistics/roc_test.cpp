// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "analysis/statistics/roc.h"
#include "tests/analysis/statistics/expect.h"

namespace limen::analysis {
namespace {

// Data and expected values: reference/roc.R (pROC).
const std::vector<int> kOutcome = {1, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 0, 1};
const std::vector<double> kFirst = {2.1, 0.4, 1.8, 0.9, 0.9, 0.2, 3.0, 1.1,
                                    1.1, 0.7, 2.6, 1.9, 0.8, 0.1, 1.2, 2.2};
const std::vector<double> kSecond = {0.6, 0.5, 0.9, 0.3, 0.4, 0.6, 0.8, 0.2,
                                     0.7, 0.6, 0.9, 0.5, 0.1, 0.3, 0.7, 0.4};

TEST(Roc, AreaVarianceAndIntervalAreThoseOfDeLong) {
  const RocArea a = rocArea(kFirst, kOutcome);
  EXPECT_NEAR(a.area, 0.828125, 1e-15);
  expectRelative(*a.variance, 0.0108119419642857, 1e-12);
  expectRelative(a.interval->low, 0.624326987675203, 1e-12);
  EXPECT_EQ(a.interval->high, 1.0);
  const double logit = std::log(0.828125 / 0.171875);
  const double reach = 1.959963984540054 * std::sqrt(0.0108119419642857) / (0.828125 * 0.171875);
  expectRelative(a.logitInterval->low, 1.0 / (1.0 + std::exp(reach - logit)), 1e-12);
  expectRelative(a.logitInterval->high, 1.0 / (1.0 + std::exp(-reach - logit)), 1e-12);
}

TEST(Roc, PairedTestIsThatOfDeLong) {
  const RocComparison c = compareRocAreas(kFirst, kSecond, kOutcome);
  expectRelative(c.second.area, 0.6484375, 1e-12);
  expectRelative(*c.second.variance, 0.0241176060267857, 1e-12);
  expectRelative(*c.covariance, 0.00721958705357143, 1e-12);
  expectRelative(*c.z, 1.255286692692575, 1e-12);
  expectRelative(*c.p, 0.209374704183515, 1e-12);
  // The same order of trials on another scale is the same predictor.
  std::vector<double> scaled = kFirst;
  for (double& s : scaled) s = std::exp(s);
  EXPECT_EQ(*compareRocAreas(kFirst, scaled, kOutcome).p, 1.0);
}

TEST(Roc, AreaUnderThePointsIsTheArea) {
  const std::vector<RocPoint> points = rocPoints(kFirst, kOutcome);
  EXPECT_EQ(points.size(), 15u);  // 14 distinct scores
  double area = 0.0;
  for (size_t i = 1; i < points.size(); ++i)
    area += 0.5 * (points[i].hitRate + points[i - 1].hitRate) *
            (points[i].falseAlarmRate - points[i - 1].falseAlarmRate);
  EXPECT_NEAR(area, 0.828125, 1e-14);
  EXPECT_EQ(points.back().hitRate, 1.0);
  EXPECT_EQ(points.back().falseAlarmRate, 1.0);
}

TEST(Roc, PerfectSeparationHasNoLogitInterval) {
  const RocArea a = rocArea({1, 2, 3, 4}, {0, 0, 1, 1});
  EXPECT_EQ(a.area, 1.0);
  EXPECT_EQ(*a.variance, 0.0);
  EXPECT_FALSE(a.logitInterval);
  EXPECT_FALSE(rocArea({1, 2}, {0, 1}).variance);
  // Two perfect predictors do not differ; a perfect and a perfectly wrong one do, but without a known error.
  EXPECT_EQ(*compareRocAreas({1, 2, 3, 4}, {0, 1, 5, 9}, {0, 0, 1, 1}).p, 1.0);
  EXPECT_FALSE(compareRocAreas({1, 2, 3, 4}, {4, 3, 2, 1}, {0, 0, 1, 1}).p);
}

TEST(Roc, MalformedInputIsRefusedByIndex) {
  expectError([] { rocArea({1, 2, 3}, {0, 1, 2}); }, "outcomes[2]");
  expectError([] { rocArea({1, 2, std::nan("")}, {0, 1, 1}); }, "scores[2]");
  expectError([] { rocArea({1, 2}, {0, 1, 1}); }, "outcomes[2]");
  expectError([] { rocPoints({1, 2}, {1, 1}); }, "all outcomes are 1");
  expectError([] { calibrate({0.5, 1.5}, {0, 1}); }, "probabilities[1]");
  expectError([] { calibrate({0.5}, {0}, 0); }, "bins");
}

TEST(Calibration, BinsAndDecompositionAreThoseByHand) {
  // Two bins: {0.2, 0.4} with outcomes {0, 1}, {0.5, 1.0} with {1, 1}.
  const Calibration c = calibrate({0.2, 0.4, 0.5, 1.0}, {0, 1, 1, 1}, 2);
  EXPECT_EQ(c.bins[0].trials, 2);
  EXPECT_NEAR(c.bins[0].meanPrediction, 0.3, 1e-15);
  EXPECT_NEAR(c.bins[0].observed, 0.5, 1e-15);
  EXPECT_NEAR(c.bins[1].meanPrediction, 0.75, 1e-15);
  EXPECT_NEAR(c.brier, (0.04 + 0.36 + 0.25 + 0.0) / 4.0, 1e-15);
  EXPECT_NEAR(c.reliability, 0.5 * 0.2 * 0.2 + 0.5 * 0.25 * 0.25, 1e-15);
  EXPECT_NEAR(c.resolution, 0.5 * 0.25 * 0.25 * 2.0, 1e-15);
  EXPECT_NEAR(c.uncertainty, 0.75 * 0.25, 1e-15);
  EXPECT_NEAR(c.brier, c.reliability - c.resolution + c.uncertainty + c.withinVariance - c.withinCovariance,
              1e-15);
  // Wilson's interval of 1 of 2 is symmetric: 1/2 -+ z / 2 / sqrt(2 + z^2).
  const double z = 1.959963984540054;
  EXPECT_NEAR(c.bins[0].wilson->low, 0.5 - 0.5 * z / std::sqrt(2.0 + z * z), 1e-12);
}

TEST(Calibration, EdgesOfBinsAreThoseThatTheyState) {
  std::vector<double> edges;
  for (int i = 0; i <= 100; ++i) edges.push_back(i / 100.0);
  const Calibration c = calibrate(edges, std::vector<int>(101, 1), 100);
  for (size_t b = 0; b < 99; ++b) EXPECT_EQ(c.bins[b].trials, 1) << b;
  EXPECT_EQ(c.bins[99].trials, 2);  // 0.99 and 1
  EXPECT_FALSE(calibrate({0.1}, {1}).bins[5].wilson);
}

}  // namespace
}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/statistics/within_subjects.h"

#include <gtest/gtest.h>

#include <cmath>

#include "analysis/statistics/detection_rates.h"
#include "tests/analysis/statistics/expect.h"

namespace limen::analysis {
namespace {

// W. Chang, Cookbook for R, "Plotting means and error bars": summarySEwithin(), which follows Morey (2008),
// of ten subjects before and after: means 47.74 and 51.43, standard error 0.7154214, half width 1.618396.
TEST(WithinSubjects, HalfWidthIsThatOfTheCookbookForR) {
  const auto intervals =
      withinSubjectIntervals({{59.4, 46.4, 46.0, 49.0, 32.5, 45.2, 60.3, 54.3, 45.4, 38.9},
                              {64.5, 52.4, 49.7, 48.7, 37.4, 49.5, 59.9, 54.1, 49.6, 48.5}});
  ASSERT_EQ(intervals.size(), 2U);
  for (const auto& [interval, mean] : {std::pair{intervals[0], 47.74}, std::pair{intervals[1], 51.43}}) {
    ASSERT_TRUE(interval);
    EXPECT_NEAR(0.5 * (interval->low + interval->high), mean, 1e-9);
    EXPECT_NEAR(0.5 * (interval->high - interval->low), 1.618396, 5e-7);
  }
}

TEST(WithinSubjects, NothingToCompareHasNoInterval) {
  EXPECT_FALSE(withinSubjectIntervals({{1.0, 2.0, 3.0}})[0]);
  EXPECT_FALSE(withinSubjectIntervals({{1.0}, {2.0}})[0]);
  EXPECT_FALSE(withinSubjectIntervals({{0.0, 0.0}, {0.5, 1.0}}, true)[0]);
  EXPECT_TRUE(withinSubjectIntervals({{0.0, 0.0}, {0.5, 1.0}}, true)[1]);
}

// Mean 0.4, standard error 0.2 / sqrt(3), t of two degrees of freedom 4.302653: on the logit scale -0.405465
// +- 4.302653 x 0.1154701 / 0.24.
TEST(RatesOverSubjects, IntervalIsOneOfTheLogit) {
  const MeanOverSubjects mean = meanRateOverSubjects({0.2, 0.4, 0.6});
  const double reach = 4.302652729911275 * (0.2 / std::sqrt(3.0)) / 0.24, logit = std::log(0.4 / 0.6);
  EXPECT_NEAR(std::log(mean.interval->low / (1.0 - mean.interval->low)), logit - reach, 1e-9);
  EXPECT_NEAR(std::log(mean.interval->high / (1.0 - mean.interval->high)), logit + reach, 1e-9);
  EXPECT_NEAR(*mean.standardDeviation, 0.2, 1e-12);
}

// "-70.9 to 182 %" was the t interval of rates such as these.
TEST(RatesOverSubjects, IntervalStaysBetween0And1) {
  for (const std::vector<double>& rates :
       {std::vector<double>{0.11, 1.0}, {0.0, 1.0}, {0.0, 0.01}, {0.99, 1.0, 1.0}, {0.0, 0.0, 0.0, 0.9}}) {
    const MeanOverSubjects mean = meanRateOverSubjects(rates);
    ASSERT_TRUE(mean.interval);
    EXPECT_GE(mean.interval->low, 0.0);
    EXPECT_LE(mean.interval->high, 1.0);
    EXPECT_LT(mean.interval->low, mean.mean);
    EXPECT_GT(mean.interval->high, mean.mean);
  }
  EXPECT_FALSE(meanRateOverSubjects({1.0, 1.0, 1.0}).interval);
  EXPECT_FALSE(meanRateOverSubjects({0.0, 0.0}).interval);
  expectError([] { meanRateOverSubjects({0.5, 1.5}); }, "rate");
}

}  // namespace
}  // namespace limen::analysis

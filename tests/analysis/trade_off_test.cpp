// SPDX-License-Identifier: BSD-3-Clause
// Constructed trade-offs whose verdict follows by hand from the rules in docs/analyse.md.
#include "analysis/sweep/trade_off.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace limen::analysis {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// A setting whose cost is exact.
TradeOffPoint exact(double cost, double error) { return {cost, cost, cost, error}; }
/// A setting whose median cost lies within an interval.
TradeOffPoint timed(double cost, double low, double high, double error) { return {cost, low, high, error}; }

std::vector<double> levelsOf(const TradeOffVerdict& verdict) {
  std::vector<double> bounds;
  for (const TradeOffVerdict::Level& level : verdict.levels) {
    bounds.push_back(level.first);
    bounds.push_back(level.last);
  }
  return bounds;
}

TEST(TradeOff, NamesTheCheapestSettingWithinEachMultipleOfTheLeastError) {
  // Least error 0.1; 0.108 is within 1.1 of it, 0.14 within 1.5, 0.19 within 2, 0.21 within none.
  const TradeOffVerdict verdict =
      weigh({exact(1, 0.21), exact(2, 0.19), exact(4, 0.14), exact(8, 0.108), exact(16, 0.1)}, 0.0);
  EXPECT_THAT(levelsOf(verdict), ElementsAre(1.0, 1.0, 1.1, 1.1, 1.5, 1.5, 2.0, 2.0));
  EXPECT_EQ(verdict.levels[0].cheapest, 4U);
  EXPECT_EQ(verdict.levels[1].cheapest, 3U);
  EXPECT_EQ(verdict.levels[2].cheapest, 2U);
  EXPECT_EQ(verdict.levels[3].cheapest, 1U);
}

TEST(TradeOff, LevelsThatNameTheSameSettingAreOne) {
  // 0.25 is beyond twice 0.1, so all four levels name the last.
  EXPECT_THAT(levelsOf(weigh({exact(1, 0.25), exact(2, 0.1)}, 0.0)), ElementsAre(1.0, 2.0));
  // 0.14 is reached from 1.5 on.
  EXPECT_THAT(levelsOf(weigh({exact(1, 0.14), exact(2, 0.1)}, 0.0)), ElementsAre(1.0, 1.1, 1.5, 2.0));
}

TEST(TradeOff, ALittleLessErrorForMuchMoreTimeIsNotWorthIt) {
  // 9.4 times the time for 5.5 % less error: lg2(9.4) = 3.23 doublings ask for 1 - 0.9^3.23 = 29 %.
  EXPECT_THAT(weigh({exact(1, 0.1), exact(9.4, 0.0945)}, 0.0).worth, ElementsAre(0));
  EXPECT_THAT(weigh({exact(1, 0.1), exact(9.4, 0.072)}, 0.0).worth, ElementsAre(0));
  EXPECT_THAT(weigh({exact(1, 0.1), exact(9.4, 0.070)}, 0.0).worth, ElementsAre(0, 1));
}

TEST(TradeOff, TwiceTheTimeMustSaveATenthOfTheError) {
  EXPECT_THAT(weigh({exact(1, 0.1), exact(2, 0.0901)}, 0.0).worth, ElementsAre(0));
  EXPECT_THAT(weigh({exact(1, 0.1), exact(2, 0.0899)}, 0.0).worth, ElementsAre(0, 1));
}

TEST(TradeOff, AGainBelowTheLeastIsNotWorthAnyTime) {
  // One per cent more time asks for 0.15 % by the rate alone; the least gain is 5 %.
  EXPECT_THAT(weigh({exact(1, 0.1), exact(1.01, 0.096)}, 0.0).worth, ElementsAre(0));
  EXPECT_THAT(weigh({exact(1, 0.1), exact(1.01, 0.094)}, 0.0).worth, ElementsAre(0, 1));
}

TEST(TradeOff, SmallGainsAddUpAgainstTheLastThatWasWorthIt) {
  // Each step alone saves 4 %; the second is 7.84 % below the first setting, at 1.21 times the time, which
  // asks for 1 - 0.9^0.275 = 2.9 %.
  EXPECT_THAT(weigh({exact(1, 0.1), exact(1.1, 0.096), exact(1.21, 0.09216)}, 0.0).worth, ElementsAre(0, 2));
}

TEST(TradeOff, OfSettingsWhoseTimesOverlapTheMoreExactIsWorthIt) {
  const TradeOffVerdict verdict = weigh({timed(1.0, 0.9, 1.2, 0.2), timed(1.1, 1.0, 1.3, 0.1)}, 0.0);
  EXPECT_THAT(verdict.worth, ElementsAre(1));
  EXPECT_THAT(verdict.beaten, ElementsAre(false, false)) << "the first may be the faster";
}

TEST(TradeOff, AChainOfOverlapsDoesNotReachPastItsFirst) {
  // The first overlaps the second and the second the third, but the first is faster than the third.
  const TradeOffVerdict verdict =
      weigh({timed(1.0, 0.9, 1.2, 0.4), timed(1.3, 1.1, 1.5, 0.2), timed(1.6, 1.4, 1.8, 0.1)}, 0.0);
  EXPECT_THAT(verdict.worth, ElementsAre(1, 2));
}

TEST(TradeOff, TiesAreThoseWithinTheLevelWhoseTimesOverlapTheWinners) {
  const TradeOffVerdict verdict = weigh({timed(1.0, 0.9, 1.1, 0.1), timed(1.1, 1.05, 1.2, 0.1),
                                         timed(1.3, 1.2, 1.4, 0.1), timed(1.0, 0.9, 1.1, 0.5)},
                                        0.0);
  ASSERT_EQ(verdict.levels.size(), 1U);
  EXPECT_EQ(verdict.levels[0].cheapest, 0U);
  EXPECT_THAT(verdict.levels[0].ties, ElementsAre(1))
      << "the third is slower, the fourth has five times the error";
}

TEST(TradeOff, TiesOfMergedLevelsHoldForTheTightest) {
  // The second is within twice the least error but not within 1.1.
  const TradeOffVerdict verdict = weigh({timed(1.0, 0.9, 1.1, 0.1), timed(1.05, 0.95, 1.2, 0.18)}, 0.0);
  EXPECT_THAT(levelsOf(verdict), ElementsAre(1.0, 2.0));
  EXPECT_THAT(verdict.levels[0].ties, IsEmpty());
}

TEST(TradeOff, BeatenIsOnlyWhatIsToldApart) {
  // Equal errors. The second's interval overlaps the first's, the third's does not.
  const std::vector<TradeOffPoint> points = {timed(1.0, 0.9, 1.1, 0.1), timed(1.1, 1.0, 1.2, 0.1),
                                             timed(1.5, 1.4, 1.6, 0.1)};
  EXPECT_THAT(weigh(points, 0.0).beaten, ElementsAre(false, false, true));
}

TEST(TradeOff, WhatMayBeTheFasterIsNotBeatenHoweverLargeItsError) {
  // The first has the longer median, but its interval begins below the other's end.
  EXPECT_THAT(weigh({timed(107, 46, 127, 0.061), timed(79, 76, 85, 0.009)}, 0.0).beaten,
              ElementsAre(false, false));
  EXPECT_THAT(weigh({timed(107, 90, 127, 0.061), timed(79, 76, 85, 0.009)}, 0.0).beaten,
              ElementsAre(true, false));
}

TEST(TradeOff, ASettingFasterThanAllOthersIsNeverBeaten) {
  EXPECT_THAT(weigh({exact(1, 0.5), exact(2, 0.1), exact(3, 0.2)}, 0.0).beaten,
              ElementsAre(false, false, true));
}

TEST(TradeOff, ErrorsWithinTheNoiseOfTheReferenceAreNotToldApart) {
  const std::vector<TradeOffPoint> points = {exact(1, 0.012), exact(2, 0.010), exact(2, 0.0125)};
  // Without noise the second is worth its time (17 % for one doubling) and beats the third.
  const TradeOffVerdict certain = weigh(points, 0.0);
  EXPECT_THAT(certain.worth, ElementsAre(0, 1));
  EXPECT_EQ(certain.levels[0].cheapest, 1U);
  // With it the first has the least error too, as far as anyone can tell.
  const TradeOffVerdict noisy = weigh(points, 0.003);
  EXPECT_THAT(noisy.worth, ElementsAre(0));
  EXPECT_EQ(noisy.levels[0].cheapest, 0U);
  EXPECT_THAT(certain.beaten, ElementsAre(false, false, true));
  EXPECT_THAT(noisy.beaten, ElementsAre(false, false, false)) << "any of them may have the least error";
}

TEST(TradeOff, TheKneeIsFarthestBelowTheLineInLogarithms) {
  // From (1, 1) to (100, 0.01). Scaled to these two decades the others stand at (0.15, 0.25) and (0.5, 0.1):
  // 0.6 and 0.4 below the line, over the square root of 2.
  const std::vector<TradeOffPoint> points = {exact(1, 1), exact(std::pow(10.0, 0.3), std::pow(10.0, -1.5)),
                                             exact(10, std::pow(10.0, -1.8)), exact(100, 0.01)};
  EXPECT_EQ(weigh(points, 0.0).knee, 1U);
}

TEST(TradeOff, AStraightFrontHasNoKnee) {
  // Error falls with the square root of time: a straight line in logarithms.
  const std::vector<TradeOffPoint> points = {exact(1, 1), exact(4, 0.5), exact(16, 0.25), exact(64, 0.125)};
  EXPECT_THAT(weigh(points, 0.0).worth, ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(weigh(points, 0.0).knee, std::nullopt);
  EXPECT_EQ(weigh({exact(1, 1), exact(4, 0.1)}, 0.0).knee, std::nullopt) << "two ends alone";
}

TEST(TradeOff, AnErrorOfZeroIsTheLeastAndLeavesOneLevel) {
  const TradeOffVerdict verdict = weigh({exact(1, 0.2), exact(2, 0.1), exact(50, 0.0)}, 0.0);
  EXPECT_THAT(levelsOf(verdict), ElementsAre(1.0, 2.0));
  EXPECT_EQ(verdict.levels[0].cheapest, 2U);
  EXPECT_THAT(verdict.worth, ElementsAre(0, 1, 2)) << "all of the error is worth any time";
}

TEST(TradeOff, ASettingThatCostsNothingDoesNotMakeAllOthersTooDear) {
  EXPECT_THAT(weigh({exact(0, 0.2), exact(10, 0.1)}, 0.0).worth, ElementsAre(0, 1));
}

TEST(TradeOff, OfNothingSaysNothingAndOfOneThatOne) {
  EXPECT_TRUE(weigh({}, 0.0).levels.empty());
  const TradeOffVerdict one = weigh({exact(1, 0.5)}, 0.0);
  EXPECT_THAT(one.worth, ElementsAre(0));
  EXPECT_THAT(one.beaten, ElementsAre(false));
  EXPECT_EQ(one.levels.size(), 1U);
}

TEST(TradeOff, InfiniteErrorsAreBeatenAndDoNotSpreadNaN) {
  const TradeOffVerdict verdict = weigh({exact(2, INFINITY), exact(1, 0.1), exact(3, INFINITY)}, 0.0);
  EXPECT_THAT(verdict.worth, ElementsAre(1));
  EXPECT_THAT(verdict.beaten, ElementsAre(true, false, true));
}

}  // namespace
}  // namespace limen::analysis

// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/session_watch.h"

#include <gtest/gtest.h>

#include <cmath>

namespace limen::study {
namespace {

constexpr int64_t kMillisecond = 1'000'000;

TEST(SessionWatch, TakesIntervalsWithinOneShowingOnly) {
  SessionWatch watch;
  TrialResult result;
  // Two showings; intervals 16, 18 and, in the second, 17 ms. The gap between them is none.
  result.frames = {{0, 0, 0, 0, 0},
                   {0, 0, 1, 16 * kMillisecond, 0},
                   {0, 0, 2, 34 * kMillisecond, 1},
                   {0, 1, 0, 1034 * kMillisecond, 0},
                   {0, 1, 1, 1051 * kMillisecond, 0}};
  Trial trial;
  watch.began(trial, 0);
  watch.ended(result, 2000 * kMillisecond);
  const IntervalStatistics times = watch.intervals();
  EXPECT_EQ(times.count, 3);
  EXPECT_DOUBLE_EQ(times.meanMs, 17.0);
  EXPECT_DOUBLE_EQ(times.sdMs, 1.0);  // sqrt((1 + 1 + 0) / 2)
  EXPECT_DOUBLE_EQ(times.longestMs, 18.0);
  EXPECT_EQ(watch.missedBlanks(), 1);
}

TEST(SessionWatch, TellsTheTimeLeftFromTrialsWithoutTheirBreaks) {
  SessionWatch watch;
  EXPECT_LT(watch.secondsLeft(), 0);
  watch.progress(2, 12);
  Trial trial;
  watch.began(trial, 0);
  watch.ended({}, 4000 * kMillisecond);
  watch.rested();  // a break of a minute
  watch.began(trial, 64'000 * kMillisecond);
  watch.ended({}, 70'000 * kMillisecond);
  EXPECT_DOUBLE_EQ(watch.secondsLeft(), 50.0);  // ten trials of (4 + 6) / 2 s
}

TEST(SessionWatch, CountsInvalidTrialsByReason) {
  SessionWatch watch;
  TrialResult late;
  late.outcome = Outcome::Invalid;
  late.reason = "2 missed frames";
  watch.ended(late, 1);
  watch.ended(late, 2);
  watch.ended({}, 3);
  EXPECT_EQ(watch.trialsInvalid(), 2);
  EXPECT_EQ(watch.trialsShown(), 3);
  EXPECT_EQ(watch.invalidReasons().at("2 missed frames"), 2);
}

}  // namespace
}  // namespace limen::study

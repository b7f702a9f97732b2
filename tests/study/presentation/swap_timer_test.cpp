// SPDX-License-Identifier: BSD-3-Clause
// Frame timing against displays whose behaviour is known: what was injected must be found, and nothing else.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "study/presentation/swap_timer.h"
#include "study/presentation/timing_run.h"
#include "study/presentation/virtual_screen.h"

namespace limen::study {
namespace {

std::vector<int64_t> run(const VirtualDisplay& display, int swaps) {
  VirtualScreen screen(display);
  std::vector<int64_t> times;
  for (int i = 0; i < swaps; ++i) times.push_back(screen.swap());
  return times;
}

/// Swaps with their missed blanks, as injected or as found.
std::map<int, int> missed(const SwapReport& report) {
  std::map<int, int> out;
  for (size_t i = 0; i < report.swaps.size(); ++i)
    if (report.swaps[i].missed > 0) out[static_cast<int>(i)] = report.swaps[i].missed;
  return out;
}

struct Case {
  double trueHz, nominalHz;
};
// A nominal rate in whole hertz, as window systems state it.
constexpr Case kDisplays[] = {{60.0, 60.0},   {59.94, 60.0},   {59.94, 59.0},
                              {144.0, 144.0}, {143.86, 144.0}, {75.02, 75.0}};

TEST(SwapTimer, FindsEveryDroppedFrameAndNoOther) {
  // Jitter of a millisecond either way; one wake-up in twenty is late by up to 0.7 of a period and recovers.
  int injected = 0;
  for (const Case& c : kDisplays)
    for (uint64_t seed = 0; seed < 40; ++seed) {
      psychometrics::Random random(psychometrics::childSeed(seed, "drops"));
      VirtualDisplay display;
      display.refreshHz = c.trueHz;
      display.nominalHz = c.nominalHz;
      display.jitterMs = 1.0;
      display.seed = seed;
      constexpr int kSwaps = 400;
      for (int i = 0; i < 5; ++i)
        display.drops[1 + static_cast<int>(random.below(kSwaps - 2))] = 1 + static_cast<int>(random.below(3));
      injected += static_cast<int>(display.drops.size());
      const SwapReport report = classifySwaps(run(display, kSwaps), {.nominalHz = c.nominalHz});
      ASSERT_TRUE(report.waits);
      EXPECT_EQ(missed(report), display.drops) << c.trueHz << " Hz, seed " << seed;
      EXPECT_EQ(report.earlySwaps, 0);
      // Uniform jitter of 1 ms over 400 swaps leaves a slope's standard error of
      // sqrt(1/3) sqrt(12) / 400^1.5 = 0.00025 ms.
      EXPECT_NEAR(report.periodMs, 1000.0 / c.trueHz, 0.00125);
    }
  EXPECT_GT(injected, 1000);
}

TEST(SwapTimer, LateWakeUpsAreNoMissedFrames) {
  for (const Case& c : kDisplays)
    for (uint64_t seed = 0; seed < 40; ++seed) {
      VirtualDisplay display;
      display.refreshHz = c.trueHz;
      display.jitterMs = 0.5;
      display.lateChance = 0.05;
      display.latestPeriods = 0.7;
      display.seed = seed;
      std::vector<int64_t> times = run(display, 399);
      // The last swap has no successor that could tell late from missed: it is on time here.
      VirtualDisplay exact = display;
      exact.lateChance = exact.jitterMs = 0.0;
      times.push_back(run(exact, 400).back());
      const SwapReport report = classifySwaps(times, {.nominalHz = c.nominalHz});
      ASSERT_TRUE(report.waits);
      EXPECT_EQ(report.missedBlanks, 0) << c.trueHz << " Hz, seed " << seed;
      EXPECT_EQ(report.earlySwaps, 0);
    }
}

TEST(SwapTimer, FindsDropsAmongLateWakeUps) {
  // A late wake-up just before a missed blank cannot be told from a missed blank before it; how many were
  // missed is known all the same.
  for (uint64_t seed = 0; seed < 100; ++seed) {
    VirtualDisplay display;
    display.jitterMs = 1.0;
    display.lateChance = 0.05;
    display.latestPeriods = 0.6;
    display.seed = seed;
    display.drops = {{50, 1}, {51, 1}, {120, 2}, {200, 1}};
    std::vector<int64_t> times = run(display, 300);
    VirtualDisplay exact = display;
    exact.lateChance = exact.jitterMs = 0.0;
    times.push_back(run(exact, 301).back());
    const SwapReport report = classifySwaps(times, {.nominalHz = 60.0});
    EXPECT_EQ(report.missedBlanks, 5) << seed;
    for (const auto& [at, count] : missed(report)) {
      const bool known = display.drops.count(at) || display.drops.count(at + 1);
      EXPECT_TRUE(known) << "at " << at << ", seed " << seed;
    }
  }
}

TEST(SwapTimer, FindsSwapsThatDidNotWait) {
  for (uint64_t seed = 0; seed < 40; ++seed) {
    VirtualDisplay display;
    display.jitterMs = 0.5;
    display.seed = seed;
    display.early = {40, 90};
    display.drops = {{60, 1}};
    const SwapReport report = classifySwaps(run(display, 200), {.nominalHz = 60.0});
    EXPECT_EQ(report.earlySwaps, 2);
    EXPECT_EQ(report.swaps[40].kind, SwapKind::Early);
    EXPECT_EQ(report.swaps[90].kind, SwapKind::Early);
    EXPECT_EQ(missed(report), display.drops);
  }
}

TEST(SwapTimer, EveryFrameOverTwoBlanksIsMissedEveryTime) {
  VirtualDisplay display;
  display.jitterMs = 0.5;
  for (int i = 1; i < 100; ++i) display.drops[i] = 1;
  const SwapReport report = classifySwaps(run(display, 100), {.nominalHz = 60.0});
  EXPECT_EQ(report.missedBlanks, 99);
  EXPECT_NEAR(report.refreshHz(), 60.0, 0.05);
}

TEST(SwapTimer, AWrongNominalRateIsFoundOut) {
  VirtualDisplay display;
  display.refreshHz = 75.0;
  const SwapReport report = classifySwaps(run(display, 200), {.nominalHz = 60.0});
  EXPECT_TRUE(report.waits);
  EXPECT_NEAR(report.refreshHz(), 75.0, 1e-6);
  EXPECT_EQ(report.missedBlanks, 0);
}

TEST(SwapTimer, SwapsThatReturnAtOnceOrAtRandomSayNothing) {
  std::vector<int64_t> fast, random;
  psychometrics::Random noise(7);
  for (int i = 0; i < 300; ++i) {
    fast.push_back(int64_t{i} * 300000);
    random.push_back((random.empty() ? 0 : random.back()) + static_cast<int64_t>(noise.uniform(5e6, 28e6)));
  }
  EXPECT_FALSE(classifySwaps(fast, {.nominalHz = 60.0}).waits);
  EXPECT_FALSE(classifySwaps(random, {.nominalHz = 60.0}).waits);
  EXPECT_FALSE(classifySwaps({0, 16}, {.nominalHz = 60.0}).waits);
  EXPECT_FALSE(classifySwaps({}, {.nominalHz = 60.0}).waits);
}

TEST(TimingRun, SaysWhatALabMustNotRestOn) {
  VirtualDisplay display;
  display.refreshHz = 60.0;
  display.jitterMs = 0.2;
  VirtualScreen good(display);
  const TimingReport fine = runTiming(good, 2.0);
  EXPECT_TRUE(fine.objections.empty());
  EXPECT_NEAR(fine.measuredHz, 60.0, 0.02);
  EXPECT_NEAR(fine.meanMs, 1000.0 / 60.0, 0.01);
  // The difference of two uniform deviates of half-width 0.2 ms has an SD of 0.2 sqrt(2/3) = 0.163 ms.
  EXPECT_NEAR(fine.sdMs, 0.163, 0.03);
  int intervals = 0;
  for (const TimingReport::Bin& bin : fine.histogram) intervals += bin.count;
  EXPECT_EQ(intervals, fine.swaps - 1);

  display.drops = {{60, 2}};
  VirtualScreen dropping(display);
  EXPECT_EQ(runTiming(dropping, 2.0).objections, std::vector<std::string>{"2 frames missed"});
  display.drops.clear();
  display.lostAt = 70;
  VirtualScreen losing(display);
  EXPECT_FALSE(runTiming(losing, 2.0).objections.empty());
  display.lostAt = -1;
  display.nominalHz = 75.0;
  VirtualScreen wrong(display);
  ASSERT_EQ(runTiming(wrong, 2.0).objections.size(), 1U);
}

}  // namespace
}  // namespace limen::study

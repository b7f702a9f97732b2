// SPDX-License-Identifier: BSD-3-Clause
// The controller of a frame's time against simulated costs, so that neither clock nor GPU decides.
#include "renderer/techniques/soft_shadows/quality/frame_time_controller.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace limen::techniques {
namespace {

/// Cost of a frame at a scale: fixed + variable scale^power, in ms.
struct Cost {
  double fixedMs = 0.0, variableMs = 1.0, power = 1.0;
  double at(double scale) const { return fixedMs + variableMs * std::pow(scale, power); }
};

struct Trace {
  std::vector<double> ms;  ///< without noise
  std::vector<double> scales;

  double worstError(double targetMs, size_t from, size_t to) const {
    double worst = 0.0;
    for (size_t i = from; i < to; ++i) worst = std::max(worst, std::abs(ms[i] / targetMs - 1.0));
    return worst;
  }
  /// Times that the error goes from beyond `band` on one side to beyond it on the other.
  int reversals(double targetMs, double band) const {
    int count = 0, side = 0;
    for (const double time : ms) {
      const double error = time / targetMs - 1.0;
      const int now = error > band ? 1 : error < -band ? -1 : 0;
      if (now != 0 && side != 0 && now != side) ++count;
      if (now != 0) side = now;
    }
    return count;
  }
};

/// `costOf` a frame's number; times arrive `delay` frames late, with relative Gaussian noise.
Trace simulate(FrameTimeController& controller, const std::function<Cost(int)>& costOf, int frames,
               int delay = 0, double noise = 0.0) {
  std::mt19937 random(7);
  std::normal_distribution<double> relative(0.0, 1.0);
  std::deque<std::pair<double, double>> underWay;
  Trace trace;
  for (int i = 0; i < frames; ++i) {
    const double scale = controller.scale(), ms = costOf(i).at(scale);
    trace.scales.push_back(scale);
    trace.ms.push_back(ms);
    underWay.emplace_back(scale, ms * std::max(0.1, 1.0 + noise * relative(random)));
    if (static_cast<int>(underWay.size()) <= delay) continue;
    controller.observe(underWay.front().first, underWay.front().second);
    underWay.pop_front();
  }
  return trace;
}

FrameTimeSettings settingsFor(double targetMs, double leastScale = 0.01) {
  FrameTimeSettings settings;
  settings.targetMs = targetMs;
  settings.leastScale = leastScale;
  return settings;
}

// The distance from the right ln scale goes as z^n with z = 1 - g + g (1 - s) z^-d for gain g, sensitivity s
// and samples d frames old. Slowest: 60 % fixed, of which the model takes 40 %, and cost by the root, so that
// near the target s = 0.5 0.4 / 0.6 = 1/3; with d = 6, z = 0.961. The right scale is (0.4 / 9.4)^2, 6.3 in
// ln, and 10 % of the time are 0.1 / (0.5 0.4) = 0.5 there: 64 samples, and delay and median on top.
TEST(FrameTimeController, ReachesTheTimeWhateverTheCostIsMadeOf) {
  for (const double fixedShare : {0.0, 0.3, 0.6})   // of the target
    for (const double power : {0.5, 1.0, 1.3})      // how the cost goes with the budget
      for (const double excess : {1.5, 4.0, 10.0})  // cost of the whole budget over the target
        for (const int delay : {0, 3, 6})           // frames
          for (const double noise : {0.0, 0.05}) {
            const double target = 2.5;
            const Cost cost{fixedShare * target, (excess - fixedShare) * target, power};
            FrameTimeController controller(settingsFor(target, 1e-4));
            const Trace trace = simulate(
                controller, [&](int) { return cost; }, 240, delay, noise);
            SCOPED_TRACE(testing::Message() << "fixed " << fixedShare << " power " << power << " excess "
                                            << excess << " delay " << delay << " noise " << noise);
            EXPECT_LT(trace.worstError(target, 80, 240), 0.1);
            // From above it may come out below once, never swing.
            EXPECT_LE(trace.reversals(target, 0.1), 1);
          }
}

TEST(FrameTimeController, FollowsASceneThatChanges) {
  const double target = 4.0;
  for (const double noise : {0.0, 0.05}) {
    FrameTimeController controller(settingsFor(target));
    const auto costOf = [](int frame) {
      return frame < 100 ? Cost{0.5, 7.0} : frame < 200 ? Cost{0.5, 21.0} : Cost{1.0, 10.0};
    };
    const Trace trace = simulate(controller, costOf, 300, 3, noise);
    EXPECT_LT(trace.worstError(target, 60, 100), 0.1);
    EXPECT_LT(trace.worstError(target, 160, 200), 0.1);
    EXPECT_LT(trace.worstError(target, 260, 300), 0.1);
    // One for each change.
    EXPECT_LE(trace.reversals(target, 0.1), 3);
  }
}

TEST(FrameTimeController, RestsAtTheLeastBudgetWhereNoneIsEnough) {
  const double target = 1.0;
  FrameTimeController controller(settingsFor(target, 0.05));
  const auto costOf = [](int frame) { return frame < 200 ? Cost{2.0, 3.0} : Cost{0.2, 3.0}; };
  const Trace trace = simulate(controller, costOf, 300, 3);
  // From there on, and not beyond.
  for (size_t i = 60; i < 200; ++i) ASSERT_DOUBLE_EQ(trace.scales[i], 0.05) << i;
  // Had something been wound up in those frames, it would take as long to unwind.
  EXPECT_LT(trace.worstError(target, 240, 300), 0.1);
  EXPECT_LE(controller.oscillations(), 1);
  // Nor short of it where the least takes 2.15, little above the target and its dead band.
  FrameTimeController nearly(settingsFor(1.9, 0.05));
  const Trace close = simulate(
      nearly,
      [](int) {
        return Cost{2.0, 3.0};
      },
      200, 3);
  EXPECT_DOUBLE_EQ(close.scales.back(), 0.05);
}

TEST(FrameTimeController, KeepsTheWholeBudgetWhereItFits) {
  FrameTimeController controller(settingsFor(10.0));
  const Trace trace = simulate(
      controller,
      [](int) {
        return Cost{1.0, 5.0};
      },
      100, 3, 0.05);
  for (const double scale : trace.scales) ASSERT_EQ(scale, 1.0);
  EXPECT_EQ(controller.oscillations(), 0);
  EXPECT_NEAR(controller.errorShare(), -0.4, 0.05);
}

TEST(FrameTimeController, HoldsStillWithinTheDeadBand) {
  const double target = 2.0;
  FrameTimeController controller(settingsFor(target));
  const Trace trace = simulate(
      controller,
      [](int) {
        return Cost{0.0, 8.0};
      },
      200, 3);
  for (size_t i = 60; i < 200; ++i) ASSERT_EQ(trace.scales[i], trace.scales[59]);
  EXPECT_LT(trace.worstError(target, 60, 200), 0.05);
}

// The median of three passes over one that stands alone.
TEST(FrameTimeController, PassesOverASlowFrame) {
  FrameTimeController controller(settingsFor(2.0));
  const auto costOf = [](int frame) { return frame == 100 ? Cost{80.0, 8.0} : Cost{0.0, 8.0}; };
  const Trace trace = simulate(controller, costOf, 140, 2);
  for (size_t i = 90; i < 140; ++i) ASSERT_EQ(trace.scales[i], trace.scales[89]) << i;
}

TEST(FrameTimeController, PassesOverWhatIsNoTime) {
  FrameTimeController controller(settingsFor(1.0));
  for (const double ms :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    controller.observe(1.0, ms);
  controller.observe(0.0, 1.0);
  EXPECT_EQ(controller.samples(), 0);
  EXPECT_EQ(controller.scale(), 1.0);
  EXPECT_EQ(controller.errorShare(), 0.0);
}

// On the way down scales spread, and times lie on the line exactly.
TEST(FrameTimeController, FindsWhatNoBudgetChanges) {
  FrameTimeController controller(settingsFor(4.0));
  simulate(
      controller,
      [](int) {
        return Cost{1.2, 20.0};
      },
      40, 3);
  EXPECT_NEAR(controller.fixedMs(), 1.2, 1e-9);
}

}  // namespace
}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/base/error.h"
#include "perception/metrics/error_map.h"
#include "tests/perception/metric_helpers.h"

namespace limen::perception {
namespace {

const Image kReference = makeImage(4, 1, 1, {1.0F, 10.0F, 100.0F, 0.01F});
const Image kTest = makeImage(4, 1, 1, {1.1F, 9.0F, 100.0F, 0.015F});

TEST(RelativeErrors, AreOfEachPixelsOwnValue) {
  EXPECT_NEAR(valueOf("relative_error", kTest, kReference), 0.5, 1e-6);
  EXPECT_NEAR(valueOf("mean_relative_error", kTest, kReference), (0.1 + 0.1 + 0.0 + 0.5) / 4.0, 1e-6);
  EXPECT_NEAR(valueOf("p99_relative_error", kTest, kReference), 0.5, 1e-6);
  const MetricResult result = measure("relative_error", pairOf(kTest, kReference));
  ASSERT_TRUE(result.map);
  EXPECT_NEAR(result.map->at(1, 0), 0.1, 1e-6);
}

TEST(RelativeErrors, StayFinite) {
  const Image zero = makeImage(2, 1, 1, {0.0F, 2.0F}), bad = makeImage(2, 1, 1, {0.25F, NAN});
  // Where the reference is 0 the error itself; what is no number counts as 1.
  EXPECT_NEAR(valueOf("mean_relative_error", bad, zero), (0.25 + 1.0) / 2.0, 1e-6);
}

TEST(DecisionFlips, CountsPixelsWhoseVerdictChanges) {
  const auto flips = [&](double difference) {
    return valueOf("decision_flips", kTest, kReference, {{"difference_cd_m2", difference}});
  };
  EXPECT_EQ(flips(1.05), 0.25);   // visible against 1, invisible against 1.1
  EXPECT_EQ(flips(9.5), 0.25);    // the other way round against 9 and 10
  EXPECT_EQ(flips(1000.0), 0.0);  // visible in both
  EXPECT_THROW(valueOf("decision_flips", Image(2, 2, 3), Image(2, 2, 3)), Error);
}

TEST(BlockArtifacts, SeeABilinearGridAndNoneInASmoothImage) {
  Image grid(64, 64, 1), smooth(64, 64, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      // Straight between the centres of 8-pixel cells, at 3.5 + 8 n; smooth: a parabola.
      const double position = (x - 3.5) / 8.0;
      const double cell = std::floor(position), t = position - cell;
      const auto knot = [](double n) { return std::fmod(n * n * 3.0 + 20.0, 7.0); };
      grid.at(x, y) = static_cast<float>(knot(cell) * (1.0 - t) + knot(cell + 1.0) * t);
      smooth.at(x, y) = static_cast<float>(0.01 * x * x + 0.02 * y * y);
    }
  EXPECT_GT(valueOf("block_artifacts", grid, grid, {{"level", int64_t{3}}}), 100.0);
  EXPECT_NEAR(valueOf("block_artifacts", smooth, smooth, {{"level", int64_t{3}}}), 1.0, 0.35);
}

TEST(ThresholdPicture, RunsFromItsBlackToItsWhiteByDecades) {
  const Image map = makeImage(4, 1, 1, {0.01F, 1.0F, 100.0F, NAN});
  const Image picture = thresholdPicture(map);
  ASSERT_EQ(picture.channels, 3);
  EXPECT_LT(picture.at(0, 0, 0), 0.01F);          // magma's black
  EXPECT_NEAR(picture.at(1, 0, 0), 0.716, 0.02);  // and its middle, 0.716 0.215 0.475
  EXPECT_NEAR(picture.at(1, 0, 1), 0.215, 0.02);
  EXPECT_GT(picture.at(2, 0, 0), 0.98F);
  EXPECT_EQ(picture.at(3, 0, 1), 1.0F);  // not finite: green
  EXPECT_EQ(picture.at(3, 0, 0), 0.0F);
}

}  // namespace
}  // namespace limen::perception

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/trim_mask.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace limen::surfaces {
namespace {

/// A circle of four rational quarters.
std::vector<glm::dvec2> circle(glm::dvec2 centre, double radius) {
  const double w = std::sqrt(0.5);
  std::vector<std::vector<glm::dvec3>> quarters;
  for (int q = 0; q < 4; ++q) {
    const auto at = [&](double turn, double reach, double weight) {
      const glm::dvec2 p = centre + radius * reach * glm::dvec2(std::cos(turn), std::sin(turn));
      return glm::dvec3(p * weight, weight);
    };
    const double start = 0.5 * M_PI * q;
    quarters.push_back(
        {at(start, 1.0, 1.0), at(start + 0.25 * M_PI, std::sqrt(2.0), w), at(start + 0.5 * M_PI, 1.0, 1.0)});
  }
  return trimLoop(quarters, 48);
}

/// A ring with a disc in its hole.
TrimRegion target() { return {{circle({0.5, 0.5}, 0.4), circle({0.5, 0.5}, 0.25), circle({0.5, 0.5}, 0.1)}}; }

TEST(TrimRegion, HoldsWhatIsInsideAnOddNumberOfLoops) {
  const TrimRegion region = target();
  EXPECT_TRUE(region.contains({0.5, 0.5}));
  EXPECT_FALSE(region.contains({0.5, 0.68}));
  EXPECT_TRUE(region.contains({0.82, 0.5}));
  EXPECT_FALSE(region.contains({0.95, 0.5}));
  EXPECT_NEAR(region.area(), M_PI * (0.16 - 0.0625 + 0.01), 1e-3);
}

/// SC-18: a mask of texels is wrong in a band of at most half a texel's diagonal on both sides of the curves.
/// A distance is interpolated, so its error falls with the square of the texel.
TEST(TrimMask, IsWrongInAThinBandAlongTheCurves) {
  const TrimRegion region = target();
  const double length = 2.0 * M_PI * (0.4 + 0.25 + 0.1);
  double last = 1.0, lastFine = 1.0;
  for (const int resolution : {16, 32, 64}) {
    const TrimMask inside(region, resolution, TrimTexture::Inside),
        distance(region, resolution, TrimTexture::Distance);
    const double error = trimError(region, inside, 500), fine = trimError(region, distance, 500);
    std::printf("%4d texels a side: area error %.5f, by distances %.6f\n", resolution, error, fine);
    EXPECT_LT(error, length * std::sqrt(0.5) / resolution);
    EXPECT_LT(error, last / 1.5);
    EXPECT_LT(fine, lastFine / 3.0);
    EXPECT_LT(fine, error);
    last = error, lastFine = fine;
  }
}

}  // namespace
}  // namespace limen::surfaces

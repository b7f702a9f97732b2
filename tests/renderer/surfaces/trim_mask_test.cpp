// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/trim_mask.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace limen::surfaces {
namespace {

/// A ring with a disc in its hole.
TrimRegion target() {
  return {
      {trimCircle({0.5, 0.5}, 0.4, 48), trimCircle({0.5, 0.5}, 0.25, 48), trimCircle({0.5, 0.5}, 0.1, 48)}};
}

TEST(TrimRegion, HoldsWhatIsInsideAnOddNumberOfLoops) {
  const TrimRegion region = target();
  EXPECT_TRUE(region.contains({0.5, 0.5}));
  EXPECT_FALSE(region.contains({0.5, 0.68}));
  EXPECT_TRUE(region.contains({0.82, 0.5}));
  EXPECT_FALSE(region.contains({0.95, 0.5}));
  EXPECT_NEAR(region.area(), M_PI * (0.16 - 0.0625 + 0.01), 1e-3);
}

/// Texels hold what the radii say, up to four texels; polygons of 192 sides lie within R (1 - cos(pi / 192))
/// < 6e-5 of the circles.
TEST(TrimMask, HoldsTheDistanceToTheCurves) {
  constexpr int kResolution = 40;
  const TrimMask mask(target(), kResolution, TrimTexture::Distance);
  for (int y = 0; y < kResolution; ++y)
    for (int x = 0; x < kResolution; ++x) {
      const double r = glm::length(glm::dvec2(x + 0.5, y + 0.5) / double(kResolution) - 0.5);
      const double signedTo = r < 0.175 ? 0.1 - r : r < 0.325 ? r - 0.25 : 0.4 - r, reach = 4.0 / kResolution;
      EXPECT_NEAR(mask.texels()[size_t(x + kResolution * y)], std::clamp(signedTo, -reach, reach), 7e-5);
    }
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

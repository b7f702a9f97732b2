// SPDX-License-Identifier: BSD-3-Clause
// Ambient occlusion against closed forms: beside a wall, under a disc, on an open plane.
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr glm::ivec2 kSizePx{48, 36};
constexpr int kRays = 1024;

class AmbientOcclusion : public TechniqueTest {
 protected:
  /// A camera 4 m above the ground that looks straight down at it.
  static void lookDown(scene::Scene& scene) {
    scene::setStillCamera(scene, {{0.0, 4.0, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 40.0});
  }
  /// x of the ground that column `x` sees.
  static double groundX(int x) {
    return (2.0 * (x + 0.5) / kSizePx.x - 1.0) * std::tan(glm::radians(20.0)) * kSizePx.x / kSizePx.y * 4.0;
  }
  static double groundZ(int y) {
    return (2.0 * (y + 0.5) / kSizePx.y - 1.0) * std::tan(glm::radians(20.0)) * 4.0;
  }
};

/// Mean of independent values of 0 or 1 deviates by more than this once in a million times (Hoeffding 1963).
double noise() { return std::sqrt(std::log(2.0e6) / (2.0 * kRays)); }

// A wall of height h from x = 0 at the distance d of a ground point, long to either side, hides the
// half-plane of directions up to the elevation atan(h / d): by the cosine, (1 - d / sqrt(d^2 + h^2)) / 2 of
// the light. What a wall of half-length L leaves out beyond its ends is less than the same of a wall at
// distance L.
TEST_F(AmbientOcclusion, RaysBesideAWallFollowItsFormFactor) {
  constexpr double kHeight = 0.5, kHalf = 400.0;
  scene::Scene scene;
  scene::addGround(scene, 2000.0);
  scene::addPart(scene, "wall", scene::box({-1.0, 0.0, -kHalf}, {0.0, kHeight, kHalf}), glm::vec3(0.5F));
  lookDown(scene);
  const Image image =
      render(scene, "ambient_occlusion/ray_traced", {{"rays", int64_t{kRays}}, {"radius", 10.0}}, kSizePx)
          .product;
  int tested = 0;
  double sum = 0.0;
  for (int y = 0; y < kSizePx.y; ++y)
    for (int x = 0; x < kSizePx.x; ++x) {
      const double d = groundX(x);
      if (d < 0.02) continue;
      const double expected = 1.0 - 0.5 * (1.0 - d / std::hypot(d, kHeight));
      ASSERT_NEAR(image.at(x, y), expected, noise()) << d;
      sum += image.at(x, y) - expected;
      ++tested;
    }
  ASSERT_GT(tested, 500);
  EXPECT_LT(std::abs(sum / tested), 5.0 * 0.5 / std::sqrt(double(kRays) * tested) + kHeight / kHalf);
}

// Under the middle of a disc of radius R at height h, the cosine-weighted share hidden is R^2 / (R^2 + h^2).
// A regular polygon of n corners has the area of a disc smaller by (1 - sin(2 pi / n) / (2 pi / n)): below
// 1e-3 of it at n = 96. The camera sees the ground from below the disc; its middle pixels lie within a pixel,
// 0.03 h, of the axis.
TEST_F(AmbientOcclusion, RaysUnderADiscFollowItsFormFactor) {
  constexpr double kDisc = 1.0, kHeight = 2.0;
  scene::Scene scene;
  scene::addGround(scene, 40.0);
  scene::Mesh disc;
  disc.positions.emplace_back(0.0, kHeight, 0.0);
  for (int i = 0; i < 96; ++i)
    disc.positions.emplace_back(kDisc * std::cos(2.0 * M_PI * i / 96), kHeight,
                                kDisc * std::sin(2.0 * M_PI * i / 96));
  for (uint32_t i = 0; i < 96; ++i) disc.triangles.emplace_back(0, 1 + i, 1 + (i + 1) % 96);
  scene::addPart(scene, "disc", disc, glm::vec3(0.5F));
  scene::setStillCamera(scene, {{0.0, 1.5, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 10.0});
  const Image image =
      render(scene, "ambient_occlusion/ray_traced", {{"rays", int64_t{kRays}}, {"radius", 10.0}}, kSizePx)
          .product;
  const double expected = 1.0 - kDisc * kDisc / (kDisc * kDisc + kHeight * kHeight);
  for (int y = 17; y <= 18; ++y)
    for (int x = 23; x <= 24; ++x) EXPECT_NEAR(image.at(x, y), expected, noise() + 1e-3);
}

TEST_F(AmbientOcclusion, NothingOccludesAnOpenPlane) {
  scene::Scene scene;
  scene::addGround(scene, 60.0);
  // 12 degrees above the ground: grazing enough for depths to rise fast.
  scene::setStillCamera(scene, scene::orbitCamera({0.0, 0.0, 0.0}, 5.0, 30.0, 12.0));
  for (const char* technique : {"ambient_occlusion/full", "ambient_occlusion/separable"})
    for (const char* method : {"points", "volume", "horizon"})
      for (const int64_t kernel : {5, 8}) {
        const Image image =
            render(scene, technique, {{"method", std::string(method)}, {"kernel", kernel}}, kSizePx).product;
        // Depths are known to 2^-24 of the distance, 3e-6 m of up to 50 m; the radius is 2.5 m, its bias 2.5
        // mm.
        for (int y = 0; y < kSizePx.y; ++y)
          for (int x = 0; x < kSizePx.x; ++x) ASSERT_NEAR(image.at(x, y), 1.0, 1e-3) << technique << method;
      }
}

// On the ground at a wall that reaches beyond the sphere all but half of the half sphere is filled. Lines of
// sight from high above measure it: volumes tend to a half there, and to 1 a radius away.
TEST_F(AmbientOcclusion, VolumesFallToAHalfAtAWall) {
  scene::Scene scene;
  scene::addGround(scene, 100.0);
  scene::addPart(scene, "wall", scene::box({-40.0, 0.0, -40.0}, {0.0, 0.3, 40.0}), glm::vec3(0.5F));
  scene::setStillCamera(scene, {{0.2, 12.0, 0.0}, {0.2, 0.0, 0.0}, {0.0, 0.0, -1.0}, 8.0});
  const glm::ivec2 sizePx{128, 96};
  const double diagonal = std::hypot(100.0, std::hypot(100.0, 0.3)), radius = 0.3;
  for (const char* technique : {"ambient_occlusion/full", "ambient_occlusion/separable"}) {
    const Image image =
        render(scene, technique,
               {{"method", std::string("volume")}, {"kernel", int64_t{16}}, {"radius", radius / diagonal}},
               sizePx)
            .product;
    const double pixel = 2.0 * 12.0 * std::tan(glm::radians(4.0)) / sizePx.y;
    for (int y = 40; y < 56; ++y)
      for (int x = 0; x < sizePx.x; ++x) {
        const double d = 0.2 + (x + 0.5 - 0.5 * sizePx.x) * pixel;
        if (d < pixel || d > 1.2) continue;
        // Share of a half ball of radius 1 beyond the plane at distance q from its middle: (1 - q)^2 (2 + q)
        // / 4.
        const double q = std::min(d / radius, 1.0), expected = 1.0 - 0.25 * (1.0 - q) * (1.0 - q) * (2.0 + q);
        // A kernel of 16 x 16 places knows the wall's edge to half a place of its row: a sixteenth of the
        // ball's width times its largest section, 3/4 of the mean; smoothing over a tile of 16 of the 19
        // pixels of a radius is flatter than the curve by at most its bend, and separable axes are looked at
        // in their mean.
        EXPECT_NEAR(image.at(x, y), expected, 0.1) << technique << " at " << d;
      }
  }
}

// k^2 places in full and 2 k separably, whatever the scene.
TEST_F(AmbientOcclusion, FetchesGrowWithTheKernelAndNotWithItsSquare) {
  const scene::Scene scene = makeScene("two_boxes");
  for (const int64_t kernel : {4, 8, 16}) {
    const double full = render(scene, "ambient_occlusion/full", {{"kernel", kernel}}, kSizePx, true)
                            .counter("fetches_per_surface_px");
    const double separable = render(scene, "ambient_occlusion/separable", {{"kernel", kernel}}, kSizePx, true)
                                 .counter("fetches_per_surface_px");
    EXPECT_EQ(full, double(kernel * kernel));
    EXPECT_EQ(separable, double(2 * kernel));
  }
}

}  // namespace
}  // namespace limen::techniques

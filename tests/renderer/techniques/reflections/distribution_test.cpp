// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/counter_random.h"
#include "tests/renderer/techniques/reflections/reflection_fixture.h"

namespace limen::techniques {
namespace {

class DistributionTraced : public ReflectionTest {};

constexpr double kGloss = 0.3, kBall = 0.15;  // rad

/// A glossy mirror below a white ball whose middle the mirrored view meets; the rest is black.
scene::Scene ballInLobe() {
  scene::Scene scene;
  scene::Material glossy;
  glossy.name = "glossy";
  glossy.albedo = glm::vec3(0.0F);
  glossy.mirror = glm::vec3(1.0F);
  glossy.glossRad = static_cast<float>(kGloss);
  scene::addPart(scene, scene::planeGrid(glm::dvec3(0.0), 0.2, 0.2, 2), glossy);
  const glm::dvec3 view(0.0, 1.0, 1.0);
  const glm::dvec3 middle = 4.0 * glm::normalize(glm::dvec3(0.0, 1.0, -1.0));
  scene::addPart(scene, "ball", scene::sphere(middle, 4.0 * std::sin(kBall), 64), glm::vec3(1.0F));
  scene::setStillCamera(scene, {view, glm::dvec3(0.0), {0.0, 1.0, 0.0}, 0.5});
  return scene;
}

/// Of a lobe cos^n the share within an angle b of the axis is (1 - cos^(n+1) b) / (1 - cos^(n+1) g); n = 0 is
/// the uniform one. 16 x 1024 paths with values of 0 and 1: Hoeffding. The ball's facets take less than 1e-3
/// of it, the width of the pixel less than that.
TEST_F(DistributionTraced, ABallInALobeHasTheShareOfItsSolidAngle) {
  const scene::Scene scene = ballInLobe();
  const double rim = 0.05, n = std::log(rim) / std::log(std::cos(kGloss));
  for (const bool phong : {false, true}) {
    Given given = {{"places", int64_t{16}},
                   {"directions", int64_t{1024}},
                   {"shading.ambient", 1.0},
                   {"shading.diffuse", 0.0},
                   {"shading.background", 0.0}};
    given["lobe"] = std::string(phong ? "phong" : "uniform");
    if (phong) given["lobe.rim"] = rim;
    const double power = phong ? n + 1.0 : 1.0;
    const double share = (1.0 - std::pow(std::cos(kBall), power)) / (1.0 - std::pow(std::cos(kGloss), power));
    const Rendered rendered = render(scene, "reflections/distribution_traced", given, {1, 1});
    EXPECT_NEAR(rendered.product.data[0], share, references::hoeffdingHalfWidth(16 * 1024) + 1e-3) << phong;
  }
}

/// Perfect mirrors: the mean over a pixel's area, which the reference at eight times the resolution has as
/// well. 64 stratified places and 64 on a grid: where an edge crosses a pixel, it crosses at most 15 of 64
/// cells, each of which is wrong by at most one sample on either side, so that the two differ by at most 2 *
/// 15 / 64 for each edge; the bound of the mean over all pixels is much smaller, as cells' errors have either
/// sign: sqrt(15 / 12 * 2) / 64 = 0.025 in pixels that have edges, for steps of 1.
TEST_F(DistributionTraced, PixelsHoldTheMeanOverTheirArea) {
  const scene::Scene scene = makeScene("mirrors/ball", {{"tessellation", int64_t{12}}});
  constexpr int kTimes = 8;
  const Image fine =
      render(scene, "reflections/reference", {{"shadows", int64_t{1}}}, {32 * kTimes, 24 * kTimes}).product;
  const Image found = render(scene, "reflections/distribution_traced",
                             {{"places", int64_t{64}}, {"shadows", int64_t{1}}}, {32, 24})
                          .product;
  Image mean(32, 24, 4);
  for (int y = 0; y < fine.height; ++y)
    for (int x = 0; x < fine.width; ++x)
      for (int c = 0; c < 3; ++c)
        mean.at(x / kTimes, y / kTimes, c) += fine.at(x, y, c) / float(kTimes * kTimes);
  EXPECT_LT(meanDifference(mean, found), 0.025);
  // An edge takes its share of half the pixels; more than one within a pixel is rare but near the silhouette.
  EXPECT_EQ(differing(mean, found, 2.0 * 15.0 / 64.0).count, 0U);
}

/// The same seed gives the same bytes, and another seed others.
TEST_F(DistributionTraced, TheSeedDecides) {
  const scene::Scene scene = ballInLobe();
  const auto product = [&](int64_t seed) {
    return render(scene, "reflections/distribution_traced",
                  {{"places", int64_t{4}}, {"directions", int64_t{8}}, {"seed", seed}}, {8, 8})
        .product.data;
  };
  EXPECT_EQ(product(1), product(1));
  EXPECT_NE(product(1), product(2));
}

}  // namespace
}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
// Soft shadows from fields and by the same rays traced, against spheres in double precision and Embree.
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

constexpr glm::ivec2 kShadowSizePx{40, 30};
constexpr const char *kFieldShadows = "visibility_fields/soft_shadows",
                     *kTracedShadows = "visibility_fields/traced_shadows";
constexpr double kRadius = 0.3, kLightRadius = 0.4;
constexpr glm::dvec3 kBalls[] = {{-0.35, 1.0, 0.05}, {0.3, 1.2, -0.1}}, kLight{0.0, 4.0, 0.0};

class FieldShadowTest : public TechniqueTest {
 protected:
  /// Two balls as one object between a light and the ground, seen from below them.
  static scene::Scene ballsUnderALight() {
    scene::Scene scene;
    scene::addGround(scene, 6.0);
    scene::Mesh balls = scene::sphere(kBalls[0], kRadius, 24);
    scene::append(balls, scene::sphere(kBalls[1], kRadius, 24));
    scene::addPart(scene, "balls", balls, glm::vec3(0.5F));
    scene.lights = {scene::lightTowards(kLight, {0.0, 0.0, 0.0}, glm::dvec2(2.0 * kLightRadius))};
    scene::setStillCamera(scene, {{0.0, 0.4, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 60.0});
    return scene;
  }
  static glm::dvec3 groundAt(int x, int y) {
    const double half = 0.4 * std::tan(glm::radians(30.0));
    return {(2.0 * (x + 0.5) / kShadowSizePx.x - 1.0) * half * kShadowSizePx.x / kShadowSizePx.y, 0.0,
            (2.0 * (y + 0.5) / kShadowSizePx.y - 1.0) * half};
  }
  static bool passes(glm::dvec3 from, glm::dvec3 to) {
    const glm::dvec3 d = glm::normalize(to - from);
    for (const glm::dvec3 ball : kBalls) {
      const glm::dvec3 away = from - ball;
      const glm::dvec3 nearest = away - glm::dot(away, d) * d;
      if (glm::dot(away, d) < 0.0 && glm::dot(nearest, nearest) < kRadius * kRadius) return false;
    }
    return true;
  }
  /// Share of the disc about the light, across the line of sight, that a point sees: 64 rings of 64 points
  /// of equal area; outlines cross some 256 of these cells, whose errors are as good as independent: 0.001.
  static double seenShare(glm::dvec3 point) {
    const glm::dvec3 z = glm::normalize(kLight - point),
                     x = glm::normalize(glm::cross(z, glm::dvec3(0.3, 0.1, 0.9))), y = glm::cross(z, x);
    int seen = 0;
    for (int ring = 0; ring < 64; ++ring)
      for (int i = 0; i < 64; ++i) {
        const double r = kLightRadius * std::sqrt((ring + 0.5) / 64.0), phi = 2.0 * M_PI * (i + 0.5) / 64.0;
        seen += passes(point, kLight + r * (std::cos(phi) * x + std::sin(phi) * y));
      }
    return seen / (64.0 * 64.0);
  }
};

// 256 rays, one in each cell: an outline crosses the 16 x 16 cells in no more than 2 * 16, two outlines in
// twice that, and each such cell errs by at most its area, half of it on average: 64 / 256 / 2 at the very
// most. The mesh is 0.998 of the ball. Fields: positions are 0.04 radii of 0.7 apart and texels 4 / (pi 64)
// at a distance of up to 1.4, together 0.06; an outline moved by that moves the border of the light's visible
// part by 0.06 * 4 / 1 * 3 / 4 = 0.17 of its 0.8, and gains cancel losses on average.
TEST_F(FieldShadowTest, BallsShadeASphericalLightAsGeometrySays) {
  const scene::Scene scene = ballsUnderALight();
  for (const bool traced : {true, false}) {
    Given given = {{"rays", int64_t{256}}};
    if (!traced) given.insert({{"positions", int64_t{4226}}, {"directions", int64_t{64}}});
    const Image image = render(scene, traced ? kTracedShadows : kFieldShadows, given, kShadowSizePx).product;
    double sum = 0.0, squares = 0.0, least = 1.0;
    for (int y = 0; y < kShadowSizePx.y; ++y)
      for (int x = 0; x < kShadowSizePx.x; ++x) {
        const double expected = seenShare(groundAt(x, y)), found = image.at(x, y);
        ASSERT_NEAR(found, expected, 0.125 + (traced ? 0.0 : 0.22)) << x << ' ' << y;
        sum += found - expected;
        squares += (found - expected) * (found - expected);
        least = std::min(least, expected);
      }
    EXPECT_LT(least, 0.3);
    // Errors of 64 such cells, each within half of its area either way: 8 * 0.29 / 256 at most.
    if (traced) {
      EXPECT_LT(std::sqrt(squares / (kShadowSizePx.x * kShadowSizePx.y)), 0.009);
    }
    EXPECT_LT(std::abs(sum / (kShadowSizePx.x * kShadowSizePx.y)), traced ? 0.005 : 0.02);
  }
}

// Under the edge of a plate at a quarter of the light's height, a ray to the light's point at l passes it at
// 3/4 x + 1/4 l: of the light's disc what lies beyond -3 x is hidden, a segment. The edge cuts up to 2 * 32
// of 1024 cells, each of which may count either way: three deviations are 3 * 0.5 * sqrt(64) / 1024 = 0.012;
// the disc leans by up to 0.05, which moves its points by 0.002 of its radius.
TEST_F(FieldShadowTest, TheLightIsAsLargeAsItSays) {
  scene::Scene scene;
  scene::addGround(scene, 6.0);
  scene::addPart(scene, "plate", scene::card({1.0, 1.0, 0.0}, {0.0, 0.0, 2.0}, {1.0, 0.0, 0.0}),
                 glm::vec3(0.5F));
  scene.lights = {scene::lightTowards(kLight, {0.0, 0.0, 0.0}, glm::dvec2(2.0 * kLightRadius))};
  constexpr double kHeight = 0.5, kHalf = 0.15;
  scene::setStillCamera(scene, {{0.0, kHeight, 0.0},
                                {0.0, 0.0, 0.0},
                                {0.0, 0.0, -1.0},
                                2.0 * glm::degrees(std::atan(kHalf / kHeight))});
  const Image found = render(scene, kTracedShadows, {{"rays", int64_t{1024}}}, {32, 32}).product;
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x) {
      const double at = (2.0 * (x + 0.5) / 32.0 - 1.0) * kHalf,
                   u = glm::clamp(-3.0 * at / kLightRadius, -1.0, 1.0);
      ASSERT_NEAR(found.at(x, y), 0.5 + (std::asin(u) + u * std::sqrt(1.0 - u * u)) / M_PI, 0.015)
          << x << ' ' << y;
    }
}

// What is beyond the light hides nothing of it, looked up or traced, near or in doubt.
TEST_F(FieldShadowTest, WhatIsBeyondTheLightCastsNoShadow) {
  scene::Scene scene = ballsUnderALight();
  scene.lights = {scene::lightTowards({0.0, 0.6, 0.0}, {0.0, 0.0, 0.0}, glm::dvec2(0.1))};
  for (const char* near : {"field", "traced", "doubtful"})
    for (const float value :
         render(scene, kFieldShadows,
                {{"rays", int64_t{16}}, {"near", std::string(near)}, {"objects", std::string("parts")}},
                kShadowSizePx)
             .product.data)
      ASSERT_EQ(value, 1.0F) << near;
  for (const float value : render(scene, kTracedShadows, {{"rays", int64_t{16}}}, kShadowSizePx).product.data)
    ASSERT_EQ(value, 1.0F);
}

// The scene's own light, against rays of another tracer to other points of it: 256 cells against 1024, as
// above.
TEST_F(FieldShadowTest, RaysToARectangleAgreeWithEmbree) {
  const scene::Scene scene = makeScene("two_boxes");
  const Image exact =
      render(scene, "soft_shadows/ray_traced", {{"tracer", std::string("cpu")}}, kShadowSizePx).product;
  const Image traced = render(scene, kTracedShadows,
                              {{"rays", int64_t{256}}, {"light", std::string("rectangle")}}, kShadowSizePx)
                           .product;
  double sum = 0.0;
  for (int y = 0; y < kShadowSizePx.y; ++y)
    for (int x = 0; x < kShadowSizePx.x; ++x) {
      ASSERT_NEAR(traced.at(x, y), exact.at(x, y), 0.125) << x << ' ' << y;
      sum += traced.at(x, y) - exact.at(x, y);
    }
  EXPECT_LT(std::abs(sum / (kShadowSizePx.x * kShadowSizePx.y)), 0.005);
}

// Errors of soft shadows fall with directions (Gaitatzes 2012, Fig. 42). As one object: around a ball alone
// its sphere errs little with any.
TEST_F(FieldShadowTest, ErrorFallsWithDirections) {
  const scene::Scene scene = ballsUnderALight();
  const Image exact = render(scene, kTracedShadows, {{"rays", int64_t{64}}}, kShadowSizePx).product;
  double before = 1.0;
  for (const int64_t directions : {8, 16, 32}) {
    const Image found = render(scene, kFieldShadows,
                               {{"rays", int64_t{64}},
                                {"positions", int64_t{4226}},
                                {"directions", directions},
                                {"objects", std::string("parts")}},
                               kShadowSizePx)
                            .product;
    double error = 0.0;
    for (size_t i = 0; i < found.data.size(); ++i) error += std::abs(double(found.data[i]) - exact.data[i]);
    // Half the width of a texel.
    EXPECT_LT(error, 0.9 * before * double(directions == 8 ? 1e6 : 1.0)) << directions;
    before = error;
  }
}

}  // namespace
}  // namespace limen::techniques

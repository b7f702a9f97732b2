// SPDX-License-Identifier: BSD-3-Clause
// Cone culling against directions counted one by one, and the sets of taps.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "renderer/techniques/soft_shadows/solid_angle/gaussian_taps.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

/// Share of the directions from `p` to the ball of radius R around the origin that meet the ball around `q`,
/// by steps of equal solid angle around the way to the origin.
double shareOfDirections(glm::dvec3 p, double lightRadius, glm::dvec3 q, double radius) {
  constexpr int kRings = 160, kAround = 320;
  const glm::dvec3 axis = -glm::normalize(p);
  const glm::dvec3 side =
      glm::normalize(glm::cross(axis, std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
  const glm::dvec3 up = glm::cross(axis, side), to = q - p;
  const double lightCosine = std::sqrt(1.0 - std::pow(lightRadius / glm::length(p), 2));
  int hits = 0;
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kAround; ++j) {
      const double cosine = 1.0 - (1.0 - lightCosine) * (i + 0.5) / kRings,
                   sine = std::sqrt(1.0 - cosine * cosine);
      const double turn = 2.0 * std::numbers::pi * (j + 0.5) / kAround;
      const glm::dvec3 way = cosine * axis + sine * (std::cos(turn) * side + std::sin(turn) * up);
      // Distance of the ray from the ball's centre.
      const double along = glm::dot(to, way);
      hits += along > 0.0 && glm::dot(to, to) - along * along <= radius * radius;
    }
  return double(hits) / double(kRings * kAround);
}

using SolidAngle = TechniqueTest;

TEST_F(SolidAngle, OnePatchHidesItsBallsShareOfTheDirections) {
  // A map of one texel makes one patch of the card, which the map is fitted to. A light far larger than the
  // card holds all of the patch's ball in its cone from most points of the ground; one of its own size from
  // none, and from many points not even the ball's centre.
  int within = 0, outside = 0;
  for (const double lightScale : {8.0, 1.0})
    for (const bool bounding : {true, false}) {
      const scene::Scene scene =
          makeScene("parallel_rectangle", {{"light_size", lightScale}, {"height", 0.6}});
      const glm::dvec2 lightSize = scene.lights[0].size;
      const double lightRadius = std::sqrt(lightSize.x * lightSize.y / std::numbers::pi);
      glm::dvec3 low(1e300), high(-1e300);
      const scene::Part& card = scene.parts.back();
      for (uint32_t t = card.firstTriangle; t < card.firstTriangle + card.triangleCount; ++t)
        for (int k = 0; k < 3; ++k) {
          const glm::dvec3 q(scene.lights[0].toLightSpace() *
                             glm::dvec4(scene.mesh.positions[scene.mesh.triangles[t][k]], 1.0));
          low = glm::min(low, q), high = glm::max(high, q);
        }
      const glm::dvec3 centre = 0.5 * (low + high), size = high - low;
      const double radius =
          bounding ? 0.5 * std::hypot(size.x, size.y) : std::sqrt(size.x * size.y / std::numbers::pi);
      const Rendered rendered = render(scene, "soft_shadows/solid_angle",
                                       {{"resolution", int64_t{1}},
                                        {"sampling", std::string("all")},
                                        {"ball", std::string(bounding ? "bounding" : "equal_area")}},
                                       {28, 21});
      for (size_t i = 0; i < rendered.product.pixels(); ++i) {
        const float* receiver = rendered.receivers.data.data() + 4 * i;
        const glm::dvec3 p(receiver[0], receiver[1], receiver[2]);
        if (receiver[3] < 0.0F || p.z < centre.z + 0.1) continue;  // the card's own points
        const glm::dvec3 to = centre - p;
        const double cosine = glm::dot(to, -p) / (glm::length(to) * glm::length(p));
        const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
        const double lightAngle = std::asin(lightRadius / glm::length(p)),
                     ballAngle = std::asin(radius / glm::length(to));
        if (angle > lightAngle + 1e-4) {
          EXPECT_EQ(rendered.product.data[i], 1.0F) << "culled by the cone";
          ++outside;
        } else if (angle + ballAngle < lightAngle) {
          // A cell of the count is cut by the ball's edge where it lies within a cell's size of it: of some
          // 4 x 160 cells on either axis half may fall to the wrong side, which mostly cancels.
          const double share = shareOfDirections(p, lightRadius, centre, radius);
          EXPECT_NEAR(rendered.product.data[i], 1.0 - share, 0.01) << i;
          ++within;
        }
      }
    }
  EXPECT_GT(within, 60);
  EXPECT_GT(outside, 60);
}

TEST_F(SolidAngle, SubsamplesTendToAllTexels) {
  // With the disc of a patch's own area a wide card adds up to what it hides, so that taps of any kind
  // estimate the same sum. A light of 16 cells on either axis leaves its rim's cells in doubt, 4 x 16 of 256,
  // for which centres decide: half of a cell each, of either sign.
  const scene::Scene scene = makeScene("parallel_rectangle", {{"height", 1.0}});
  Given given = {
      {"resolution", int64_t{64}}, {"ball", std::string("equal_area")}, {"sampling", std::string("all")}};
  const Rendered all = render(scene, "soft_shadows/solid_angle", given, {40, 30});
  for (const char* sampling : {"regular", "gaussian_poisson"}) {
    given["sampling"] = std::string(sampling);
    double last = 1e300;
    for (const int64_t taps : {4, 16, 48}) {
      given["sampling.taps"] = taps;
      const Rendered some = render(scene, "soft_shadows/solid_angle", given, {40, 30});
      double squares = 0.0;
      int partly = 0;
      for (size_t i = 0; i < some.product.pixels(); ++i)
        if (all.product.data[i] < 1.0F)
          squares += std::pow(double(some.product.data[i]) - double(all.product.data[i]), 2), ++partly;
      ASSERT_GT(partly, 50);
      const double rms = std::sqrt(squares / partly);
      EXPECT_LT(rms, last) << sampling << " " << taps;
      last = rms;
    }
    EXPECT_LT(last, 0.05) << sampling;
  }
}

TEST(GaussianTaps, StandForTheWholeSquareAndKeepApart) {
  for (const double sigma : {0.2, 0.5, 10.0}) {
    const std::vector<glm::vec4> taps = gaussianTaps(256, sigma, 3);
    ASSERT_EQ(taps.size(), 256U);
    double shares = 0.0, integral = 0.0, closest = 1e300;
    int middle = 0;
    for (size_t i = 0; i < taps.size(); ++i) {
      ASSERT_TRUE(taps[i].x >= 0.0F && taps[i].x < 1.0F && taps[i].y >= 0.0F && taps[i].y < 1.0F);
      shares += taps[i].z, integral += taps[i].z * taps[i].x * taps[i].x;
      middle += std::abs(taps[i].x - 0.5F) < 0.25F && std::abs(taps[i].y - 0.5F) < 0.25F;
      for (size_t j = 0; j < i; ++j)
        closest = std::min(
            closest, glm::distance(glm::dvec2(taps[i]), glm::dvec2(taps[j])) / std::sqrt(double(taps[i].z)));
    }
    EXPECT_NEAR(shares, 1.0, 1e-5);
    // The mean of x^2 over the square is 1/3; with 256 independent darts of the widest spread of shares it
    // would be known to about 0.1.
    EXPECT_NEAR(integral, 1.0 / 3.0, 0.1) << sigma;
    // Half the square of its share to itself at least: independent darts come as near as a sixteenth.
    EXPECT_GT(closest, 0.4) << sigma;
    // The middle quarter holds (erf(0.25 / (sigma sqrt 2)) / erf(0.5 / (sigma sqrt 2)))^2 of them.
    const double expected =
        std::pow(std::erf(0.25 / (sigma * std::sqrt(2.0))) / std::erf(0.5 / (sigma * std::sqrt(2.0))), 2);
    EXPECT_NEAR(middle / 256.0, expected, 0.1) << sigma;
  }
}

}  // namespace
}  // namespace limen::techniques

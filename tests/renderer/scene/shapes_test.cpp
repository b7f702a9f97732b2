// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/shapes.h"

#include <gtest/gtest.h>

#include <array>
#include <numbers>
#include <vector>

#include "tests/renderer/scene/geometry_checks.h"

namespace limen::scene {
namespace {

using checks::closedManifold;
using checks::signedVolume;
constexpr double kPi = std::numbers::pi;

double volumeOf(const Mesh& mesh) { return signedVolume(mesh, 0, mesh.triangles.size()); }
bool closed(const Mesh& mesh) { return closedManifold(mesh, 0, mesh.triangles.size()); }

TEST(Shapes, BoxIsClosedAndHasItsVolume) {
  const Mesh mesh = box({-1.0, 2.0, 0.5}, {1.0, 5.0, 1.0});
  EXPECT_TRUE(closed(mesh));
  EXPECT_NEAR(volumeOf(mesh), 2.0 * 3.0 * 0.5, 1e-12);
  EXPECT_NEAR(checks::surfaceArea(mesh), 2.0 * (6.0 + 1.5 + 1.0), 1e-12);
}

TEST(Shapes, SphereIsClosedOnItsRadiusAndItsVolumeGrowsTowardsTheBall) {
  const glm::dvec3 centre(1.0, -2.0, 3.0);
  const double ball = 4.0 / 3.0 * kPi * 8.0;
  double before = 0.0;
  for (const int cells : {1, 2, 3, 16, 48}) {
    const Mesh mesh = sphere(centre, 2.0, cells);
    EXPECT_EQ(mesh.triangles.size(), 8U * cells * cells);
    EXPECT_TRUE(closed(mesh)) << cells;
    for (const glm::dvec3& p : mesh.positions) EXPECT_NEAR(glm::length(p - centre), 2.0, 1e-12);
    const double volume = volumeOf(mesh);
    EXPECT_GT(volume, before);
    EXPECT_LT(volume, ball);
    before = volume;
  }
  EXPECT_NEAR(before, ball, 0.002 * ball);
  // One segment: the octahedron, 4/3 r^3.
  EXPECT_NEAR(volumeOf(sphere(centre, 2.0, 1)), 4.0 / 3.0 * 8.0, 1e-12);
}

TEST(Shapes, FrustumIsClosedAndHasThePrismatoidVolume) {
  const glm::dvec3 base(1.0, 1.0, 1.0), top(2.0, 3.0, -1.0);  // height 3
  for (const int n : {3, 8, 64})
    for (const double topRadius : {0.5, 0.2, 0.0}) {
      const Mesh mesh = frustum(base, top, 0.5, topRadius, n);
      // Area of a regular n-gon of circumradius r is n/2 sin(2 pi/n) r^2; volume h/3 (A + sqrt(A B) + B).
      const double unit = 0.5 * n * std::sin(2.0 * kPi / n);
      const double expected = 3.0 / 3.0 * unit * (0.25 + 0.5 * topRadius + topRadius * topRadius);
      EXPECT_TRUE(closed(mesh)) << n << " " << topRadius;
      EXPECT_NEAR(volumeOf(mesh), expected, 1e-12) << n << " " << topRadius;
    }
}

TEST(Shapes, StraightTubeHasTheVolumeOfItsFrusta) {
  constexpr int kSides = 7;
  const std::array<glm::dvec3, 3> points = {glm::dvec3(0.0), glm::dvec3(0.0, 2.0, 0.0),
                                            glm::dvec3(0.0, 3.0, 0.0)};
  const std::array<double, 3> radii = {0.5, 0.25, 1.0};
  const Mesh mesh = tube(points, radii, kSides);
  // As of a frustum: unit area by h/3 (r^2 + r R + R^2), heights 2 and 1.
  const double unit = 0.5 * kSides * std::sin(2.0 * kPi / kSides);
  const double expected = unit * (2.0 / 3.0 * (0.25 + 0.125 + 0.0625) + 1.0 / 3.0 * (0.0625 + 0.25 + 1.0));
  EXPECT_TRUE(closed(mesh));
  EXPECT_NEAR(volumeOf(mesh), expected, 1e-12);
}

TEST(Shapes, BentTubeIsClosedAndHasTheVolumeOfItsPathByItsSection) {
  constexpr int kSides = 24, kRings = 200;
  std::vector<glm::dvec3> points;
  for (int i = 0; i <= kRings; ++i) {
    const double angle = 1.5 * kPi * i / kRings;
    points.emplace_back(2.0 * std::cos(angle), 0.0, 2.0 * std::sin(angle));
  }
  const std::vector<double> radii(points.size(), 0.3);
  const Mesh mesh = tube(points, radii, kSides);
  EXPECT_TRUE(closed(mesh));
  // Pappus: section by the path of its centre; pieces of 1.35 degrees, and the end sections that stand half a
  // piece askew, change it by less than their angle squared.
  const double section = 0.5 * kSides * std::sin(2.0 * kPi / kSides) * 0.09, turn = 1.5 * kPi / kRings;
  const double expected = section * 1.5 * kPi * 2.0;
  EXPECT_NEAR(volumeOf(mesh), expected, turn * turn * expected);
}

TEST(Shapes, GroundFacesUpAndHasItsArea) {
  const Mesh mesh = planeGrid({1.0, 2.0, 3.0}, 6.0, 4.0, 5);
  EXPECT_EQ(mesh.triangles.size(), 50U);
  EXPECT_NEAR(checks::surfaceArea(mesh), 24.0, 1e-12);
  Bounds bounds;
  for (const glm::dvec3& p : mesh.positions) bounds.extend(p);
  EXPECT_EQ(bounds.low, glm::dvec3(-2.0, 2.0, 1.0));
  EXPECT_EQ(bounds.high, glm::dvec3(4.0, 2.0, 5.0));
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    EXPECT_GT(glm::cross(checks::corner(mesh, t, 1) - checks::corner(mesh, t, 0),
                         checks::corner(mesh, t, 2) - checks::corner(mesh, t, 0))
                  .y,
              0.0);
}

TEST(Shapes, CardFacesTheCrossProductOfItsHalves) {
  const Mesh mesh = card({0.0, 0.0, 0.0}, {2.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  EXPECT_NEAR(checks::surfaceArea(mesh), 8.0, 1e-12);
  const auto hit = checks::intersect(mesh, {1.9, 0.9, 5.0}, {0.0, 0.0, -1.0});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 5.0, 1e-12);
  EXPECT_GT(hit->normal.z, 0.0);
}

TEST(Random, DirectionsAreUnitAndFillTheSphereEvenly) {
  Random random(7);
  glm::dvec3 sum(0.0), squares(0.0);
  constexpr int kDraws = 20000;
  for (int i = 0; i < kDraws; ++i) {
    const glm::dvec3 d = random.direction();
    EXPECT_NEAR(glm::length(d), 1.0, 1e-12);
    sum += d, squares += d * d;
  }
  // Standard deviation of a coordinate is sqrt(1/3), of its square sqrt(4/45); five standard errors.
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(sum[k] / kDraws, 0.0, 5.0 * std::sqrt(1.0 / 3.0 / kDraws));
    EXPECT_NEAR(squares[k] / kDraws, 1.0 / 3.0, 5.0 * std::sqrt(4.0 / 45.0 / kDraws));
  }
}

}  // namespace
}  // namespace limen::scene

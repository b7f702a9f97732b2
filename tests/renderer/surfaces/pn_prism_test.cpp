// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/pn_prism.h"

#include <gtest/gtest.h>

#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/pn_triangles.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::surfaces {
namespace {

using glm::dvec3;
using scene::Random;

/// Normals up to 120 degrees from the face's, needles, and triangles without an area.
PnBase hostileBase(Random& random, int trial) {
  PnBase base;
  for (size_t c = 0; c < 3; ++c) {
    base.positions[c] = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    base.normals[c] = random.direction();
  }
  if (trial % 5 == 1)
    base.positions[2] = glm::mix(base.positions[0], base.positions[1], 0.3) + 1e-5 * random.direction();
  if (trial % 50 == 2) base.positions[2] = glm::mix(base.positions[0], base.positions[1], 0.3);
  if (trial % 50 == 3) base.positions[2] = base.positions[1];
  if (trial % 50 == 4) base.positions = {base.positions[0], base.positions[0], base.positions[0]};
  return base;
}

/// How far a point lies outside, and how far apart corners are. A face may have no area where the prism has
/// none.
double outsideBy(const PnPrism& prism, const dvec3& p) {
  double worst = -1e300;
  for (const auto& t : kPrismTriangles) {
    const dvec3 a = prism.corners[t[0]], n = glm::cross(prism.corners[t[1]] - a, prism.corners[t[2]] - a);
    if (glm::length(n) > 0.0) worst = std::max(worst, glm::dot(glm::normalize(n), p - a));
  }
  return worst;
}

double sizeOf(const std::array<dvec3, 10>& points) {
  dvec3 low(1e300), high(-1e300);
  for (const dvec3& p : points) low = glm::min(low, p), high = glm::max(high, p);
  return glm::length(high - low);
}

/// Points of the surface itself, found by another way than the control points of parts.
void expectContained(int triangles, int points) {
  Random random(7);
  for (int trial = 0; trial < triangles; ++trial) {
    const PnTriangle triangle = pnTriangle(hostileBase(random, trial));
    const PnPrism prism = pnPrism(3, triangle.points);
    const double size = sizeOf(triangle.points);
    double worst = -1e300;
    for (int i = 0; i < points; ++i) {
      double u = random.uniform(0, 1), v = random.uniform(0, 1);
      if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      if (i % 4 == 0) u = 0.0;
      if (i % 4 == 1) v = 1.0 - u;
      worst = std::max(
          worst,
          outsideBy(prism, triangleJet(3, triangle.points.data(), trianglePoint(u, v), Order::Position).p));
    }
    // The slack; a triangle that is one point has nothing but rounding.
    ASSERT_LE(worst, size > 1e-12 ? -1e-4 * size : 1e-12) << "triangle " << trial;
  }
}

TEST(PnPrism, ContainsTheSurfaceOfRandomTriangles) { expectContained(20000, 16); }
TEST(PnPrism, ContainsTheSurfaceOfManyRandomTriangles) {
  if (!std::getenv("LIMEN_LONG_TESTS")) GTEST_SKIP() << "set LIMEN_LONG_TESTS for 100,000 triangles";
  expectContained(100000, 64);
}

TEST(PnPrism, OfAPartContainsThePart) {
  Random random(8);
  for (int trial = 0; trial < 500; ++trial) {
    const PnTriangle triangle = pnTriangle(hostileBase(random, trial));
    const double size = sizeOf(triangle.points);
    for (int level = 1; level <= 2; ++level) {
      const std::vector<TrianglePart> parts = partsOf(level);
      ASSERT_EQ(parts.size(), level == 1 ? 4U : 16U);
      double area = 0.0;
      for (const TrianglePart& part : parts) {
        area += (part[1].x - part[0].x) * (part[2].y - part[0].y) -
                (part[1].y - part[0].y) * (part[2].x - part[0].x);
        const PnPrism prism = pnPrism(3, triangle.points, part);
        for (int i = 0; i < 8; ++i) {
          dvec3 w(random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1));
          w /= w.x + w.y + w.z;
          const dvec3 at = w.x * part[0] + w.y * part[1] + w.z * part[2];
          ASSERT_LE(outsideBy(prism, triangleJet(3, triangle.points.data(),
                                                 DomainPoint{at.x, at.y, at.z, 0.0}, Order::Position)
                                         .p),
                    1e-12 * size + 1e-15);
        }
      }
      EXPECT_NEAR(area, 1.0, 1e-12);  // they cover the domain: its area is 1/2
    }
  }
}

/// A flat triangle's prism is the triangle with the slack: a prism that is merely large would contain
/// everything.
TEST(PnPrism, OfAFlatTriangleIsFlat) {
  PnBase base;
  base.positions = {dvec3{0, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  base.normals = {dvec3{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  const PnPrism prism = pnPrism(3, pnTriangle(base).points);
  for (size_t c = 0; c < 6; ++c) {
    EXPECT_LT(glm::length(prism.corners[c] - base.positions[c % 3]), 0.02) << c;
    EXPECT_LT(std::abs(prism.corners[c].z), 0.003);
    EXPECT_EQ(prism.corners[c].z > 0.0, c >= 3);
  }
  // Corners' parameters, extended beyond the domain by the slack.
  const glm::dvec2 expected[] = {{1, 0}, {0, 1}, {0, 0}};
  for (size_t c = 0; c < 3; ++c) EXPECT_LT(glm::length(prism.parameters[c] - expected[c]), 0.02) << c;
}

/// Bounded size also where sides of the base are nearly parallel: moved sides would meet far away.
TEST(PnPrism, OfANeedleStaysNear) {
  Random random(9);
  for (int trial = 0; trial < 2000; ++trial) {
    const PnTriangle triangle = pnTriangle(hostileBase(random, 1));
    const PnPrism prism = pnPrism(3, triangle.points);
    for (const dvec3& corner : prism.corners)
      ASSERT_LT(glm::length(corner - triangle.points[0]), 12.0 * sizeOf(triangle.points));
  }
}

}  // namespace
}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/normal.h"

#include <gtest/gtest.h>

#include "tests/renderer/surfaces/bezier_oracle.h"

namespace limen::surfaces {
namespace {

using P = glm::dvec4;

/// An octant of the unit sphere, exact (Piegl and Tiller 1997, section 8.5): v = 1 is the pole (0, 0, 1).
PatchSet octant() {
  const double h = std::sqrt(0.5);
  const std::array<glm::dvec2, 3> arc = {{{1, 0}, {1, 1}, {0, 1}}};
  const std::array<double, 3> weights = {1.0, h, 1.0};
  std::vector<P> points;
  for (size_t j = 0; j < 3; ++j)
    for (size_t i = 0; i < 3; ++i)
      points.push_back(
          weighted({arc[i].x * arc[j].x, arc[i].y * arc[j].x, arc[j].y}, weights[i] * weights[j]));
  PatchSet set;
  addRectangle(set, 2, 2, points);
  return set;
}

/// On a sphere the normal is the position, at the pole as elsewhere.
TEST(Normals, OfASphereArePositionsAtThePoleToo) {
  const PatchSet set = octant();
  for (int j = 0; j <= 64; ++j)
    for (int i = 0; i <= 8; ++i) {
      const DomainPoint at = rectangleGridPoint(i, 8, j, 64);
      const SurfaceNormal normal = normalAt(set, set.patches[0], at);
      EXPECT_LT(glm::length(normal.direction - evaluate(set, set.patches[0], at).p), 1e-14) << i << ' ' << j;
      EXPECT_EQ(normal.rung, j == 64 ? NormalRung::Limit : NormalRung::Tangents);
    }
}

/// Between the rungs too: nearer and nearer the pole, no jump beyond the rounding of the derivatives.
TEST(Normals, AreContinuousTowardsThePole) {
  const PatchSet set = octant();
  for (double gap = 1e-3; gap > 1e-16; gap *= 0.3) {
    const DomainPoint at{0.37, 1.0 - gap, 0.63, gap};
    const SurfaceNormal normal = normalAt(set, set.patches[0], at);
    EXPECT_LT(glm::length(normal.direction - evaluate(set, set.patches[0], at).p), 1e-7) << gap;
  }
}

/// Whichever side collapses, the normal points to the side where it points next to it.
TEST(Normals, AtACollapsedSidePointLikeTheirNeighbours) {
  scene::Random random(2);
  for (int side = 0; side < 4; ++side)
    for (int trial = 0; trial < 20; ++trial) {
      PatchSet set;
      std::vector<P> points;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i)
          points.emplace_back(i + random.uniform(-0.2, 0.2), j + random.uniform(-0.2, 0.2),
                              random.uniform(-0.2, 0.2), 1.0);
      for (int k = 0; k < 4; ++k) {
        const std::array<int, 4> index = {k, 3 + 4 * k, 12 + k, 4 * k};
        const std::array<P, 4> to = {P(1.5, 0, 0, 1), P(3, 1.5, 0, 1), P(1.5, 3, 0, 1), P(0, 1.5, 0, 1)};
        points[size_t(index[size_t(side)])] = to[size_t(side)];
      }
      addRectangle(set, 3, 3, points);
      const DomainPoint at = sidePoint(Domain::Rectangle, side, 3, 8);
      const glm::dvec2 in(at.u == 0 ? 1e-6 : at.u == 1 ? -1e-6 : 0, at.v == 0 ? 1e-6 : at.v == 1 ? -1e-6 : 0);
      const SurfaceNormal normal = normalAt(set, set.patches[0], at);
      EXPECT_EQ(normal.rung, NormalRung::Limit);
      const SurfaceNormal beside = normalAt(set, set.patches[0], rectanglePoint(at.u + in.x, at.v + in.y));
      EXPECT_EQ(beside.rung, NormalRung::Tangents);
      EXPECT_LT(glm::length(normal.direction - beside.direction), 1e-4);
    }
}

/// Three control points in the same corner of a bicubic leave no first-order limit there, and a patch that is
/// a line or a point has no normal at all; nothing is NaN.
TEST(Normals, OfWorseDegeneraciesAreUnitAndSayWhereTheyCameFrom) {
  const auto rungOf = [](const std::vector<P>& points) {
    PatchSet set;
    addRectangle(set, 3, 3, points);
    const SurfaceNormal normal = normalAt(set, set.patches[0], rectanglePoint(0, 0));
    EXPECT_NEAR(glm::length(normal.direction), 1.0, 1e-12);
    return normal.rung;
  };
  std::vector<P> flat, corner, line, point(16, P(1, 2, 3, 1));
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) {
      flat.emplace_back(i, j, 0, 1), line.emplace_back(i + j, 0, 0, 1);
      corner.push_back(i < 3 && j < 3 ? P(0, 0, 0, 1) : P(i, j, 0, 1));
    }
  EXPECT_EQ(rungOf(flat), NormalRung::Tangents);
  EXPECT_EQ(rungOf(corner), NormalRung::Inward);
  EXPECT_EQ(rungOf(line), NormalRung::None);
  EXPECT_EQ(rungOf(point), NormalRung::None);
}

TEST(Normals, OfAFieldComeFromItUnlessItVanishes) {
  PatchSet set;
  const std::array<P, 3> points = {P(1, 0, 0, 1), P(0, 1, 0, 1), P(0, 0, 0, 1)};
  addTriangle(set, 1, points, 1, std::array<glm::dvec3, 3>{{{1, 0, 1}, {-1, 0, 1}, {0, 0, 1}}});
  addTriangle(set, 1, points, 1, std::array<glm::dvec3, 3>{{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}}});
  const DomainPoint middle = triangleGridPoint(1, 1, 2);
  SurfaceNormal normal = normalAt(set, set.patches[0], middle);
  EXPECT_EQ(normal.rung, NormalRung::Field);
  EXPECT_LT(glm::length(normal.direction - glm::dvec3(0, 0, 1)), 1e-15);
  normal = normalAt(set, set.patches[1], middle);
  EXPECT_EQ(normal.rung, NormalRung::Tangents);
  EXPECT_LT(glm::length(normal.direction - glm::dvec3(0, 0, 1)), 1e-15);
}

}  // namespace
}  // namespace limen::surfaces

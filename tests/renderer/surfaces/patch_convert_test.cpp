// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/patch_convert.h"

#include <gtest/gtest.h>

#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/quadrics.h"
#include "tests/renderer/surfaces/bezier_oracle.h"

namespace limen::surfaces {
namespace {

using scene::Random;

double gap(const PatchSet& a, const Patch& p, const DomainPoint& at, const PatchSet& b, const Patch& q,
           const DomainPoint& there) {
  return glm::length(evaluate(a, p, at).p - evaluate(b, q, there).p);
}

/// SC-06, both ways and with weights.
TEST(PatchConvert, TrianglesAreTheirRectangles) {
  Random random(1);
  for (int n = 1; n <= kMaxDegree; ++n) {
    const PatchSet set = oracle::randomPatch(random, Domain::Triangle, n, n, 10.0);
    PatchSet out;
    const Patch patch = triangleAsRectangle(set, set.patches[0], out);
    EXPECT_TRUE(isCollapsed(out, patch, 2));
    for (int j = 0; j <= 6; ++j)
      for (int i = 0; i <= 6; ++i) {
        const double x = i / 6.0, y = j / 6.0;
        EXPECT_LT(gap(out, patch, rectanglePoint(x, y), set, set.patches[0], trianglePoint(x * (1.0 - y), y)),
                  1e-12);
      }
  }
}

TEST(PatchConvert, RectanglesAreTheirTwoTriangles) {
  Random random(2);
  for (int m = 1; m <= 8; ++m)
    for (int n = 1; m + n <= kMaxDegree; ++n) {
      const PatchSet set = oracle::randomPatch(random, Domain::Rectangle, m, n, 10.0);
      PatchSet out;
      const std::array<Patch, 2> halves = rectangleAsTriangles(set, set.patches[0], out);
      const std::array<std::array<glm::dvec2, 3>, 2> corners = {
          {{{{0, 0}, {1, 0}, {1, 1}}}, {{{0, 0}, {1, 1}, {0, 1}}}}};
      for (size_t half = 0; half < 2; ++half)
        for (int j = 0; j <= 5; ++j)
          for (int i = 0; i + j <= 5; ++i) {
            const DomainPoint at = triangleGridPoint(i, j, 5);
            const auto& [a, b, c] = corners[half];
            const glm::dvec2 uv = at.u * a + at.v * b + at.w() * c;
            EXPECT_LT(gap(out, halves[half], at, set, set.patches[0], rectanglePoint(uv.x, uv.y)), 1e-11);
          }
    }
}

TEST(PatchConvert, ElevationChangesNoSurfaceAndNoNeighbours) {
  Random random(3);
  for (int n = 1; n <= 7; ++n) {
    const PatchSet set = oracle::randomPatch(random, Domain::Rectangle, n, 2, 10.0), up = elevated(set, 8, 9);
    EXPECT_EQ(up.patches[0].degreeU, 8);
    EXPECT_EQ(up.patches[0].degreeV, 9);
    for (int k = 0; k < 20; ++k) {
      const DomainPoint at = rectanglePoint(random.uniform(0, 1), random.uniform(0, 1));
      EXPECT_LT(gap(set, set.patches[0], at, up, up.patches[0], at), 1e-12);
    }
  }
  PatchSet sphere = unitSphere(), up = elevated(sphere, 3, 3);
  EXPECT_EQ(findNeighbours(sphere).shared, findNeighbours(up).shared);
}

/// Exact: every point at its distance, every normal outwards.
TEST(Quadrics, AreExactAndClosed) {
  PatchSet sphere = unitSphere();
  SideCounts counts = findNeighbours(sphere);
  EXPECT_EQ(counts.shared, 24U);
  EXPECT_EQ(counts.collapsed, 8U);
  EXPECT_EQ(counts.open, 0U);
  PatchSet ring = torus(2.0, 0.5);
  counts = findNeighbours(ring);
  EXPECT_EQ(counts.shared, 64U);
  EXPECT_EQ(counts.open + counts.collapsed, 0U);
  PatchSet can = cylinder(0.7, 1.5);
  counts = findNeighbours(can);
  EXPECT_EQ(counts.shared, 40U);
  EXPECT_EQ(counts.collapsed, 8U);
  EXPECT_EQ(counts.open, 0U);
  for (int j = 0; j <= 10; ++j)
    for (int i = 0; i <= 10; ++i) {
      const DomainPoint at = rectangleGridPoint(i, 10, j, 10);
      for (const Patch& patch : sphere.patches)
        EXPECT_NEAR(glm::length(evaluate(sphere, patch, at).p), 1.0, 1e-15);
      for (const Patch& patch : ring.patches) {
        const SurfaceJet jet = evaluate(ring, patch, at);
        const double outer = glm::length(glm::dvec2(jet.p.x, jet.p.z)) - 2.0;
        EXPECT_NEAR(outer * outer + jet.p.y * jet.p.y, 0.25, 1e-14);
        const glm::dvec3 middle = 2.0 * glm::normalize(glm::dvec3(jet.p.x, 0.0, jet.p.z));
        EXPECT_GT(glm::dot(glm::cross(jet.u, jet.v), jet.p - middle), 0.0);
      }
    }
}

}  // namespace
}  // namespace limen::surfaces

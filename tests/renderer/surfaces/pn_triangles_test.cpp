// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/pn_set.h"

#include <gtest/gtest.h>

#include <cstring>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/normal.h"
#include "tests/renderer/surfaces/bezier_oracle.h"

namespace limen::surfaces {
namespace {

using scene::Random;

PnBase randomBase(Random& random) {
  PnBase base;
  for (size_t c = 0; c < 3; ++c) {
    base.positions[c] = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    base.normals[c] = random.direction();
  }
  return base;
}

glm::dvec3 fieldAt(const PnTriangle& triangle, double u, double v) {
  return triangleJet(2, triangle.normals.data(), trianglePoint(u, v), Order::Position).p;
}

/// The thesis' list (section 6.1.3), written out with its 1-based names.
TEST(PnTriangle, HasTheControlPointsOfTheThesis) {
  Random random(1);
  for (int trial = 0; trial < 50; ++trial) {
    const PnBase base = randomBase(random);
    const auto& [p1, p2, p3] = base.positions;
    const auto& [n1, n2, n3] = base.normals;
    const auto w = [](glm::dvec3 i, glm::dvec3 j, glm::dvec3 n) { return glm::dot(j - i, n); };
    const glm::dvec3 b210 = (2.0 * p1 + p2 - w(p1, p2, n1) * n1) / 3.0,
                     b120 = (2.0 * p2 + p1 - w(p2, p1, n2) * n2) / 3.0,
                     b021 = (2.0 * p2 + p3 - w(p2, p3, n2) * n2) / 3.0,
                     b012 = (2.0 * p3 + p2 - w(p3, p2, n3) * n3) / 3.0,
                     b102 = (2.0 * p3 + p1 - w(p3, p1, n3) * n3) / 3.0,
                     b201 = (2.0 * p1 + p3 - w(p1, p3, n1) * n1) / 3.0;
    const glm::dvec3 e = (b210 + b120 + b021 + b012 + b102 + b201) / 6.0, v = (p1 + p2 + p3) / 3.0;
    const std::array<glm::dvec3, 10> expected = {p1,   b210, b201, b120, e + (e - v) / 2.0,
                                                 b102, p2,   b021, b012, p3};
    const PnTriangle triangle = pnTriangle(base);
    for (size_t i = 0; i < 10; ++i) EXPECT_LT(glm::length(triangle.points[i] - expected[i]), 1e-14) << i;
  }
}

/// b111 is chosen so that a quadratic patch is reproduced: a paraboloid with its own normals is not one (its
/// normals are scaled), but a plane is, whatever its position.
TEST(PnTriangle, OfAFlatTriangleIsItself) {
  Random random(2);
  PnBase base = randomBase(random);
  const glm::dvec3 n = glm::normalize(
      glm::cross(base.positions[1] - base.positions[0], base.positions[2] - base.positions[0]));
  base.normals = {n, n, n};
  for (const PnNormals normals : {PnNormals::Linear, PnNormals::Vlachos, PnNormals::VanOverveldWyvill,
                                  PnNormals::Farin, PnNormals::CorrectedFarin, PnNormals::LeeJen})
    for (const bool halfH : {false, true}) {
      const PnTriangle triangle = pnTriangle(base, {normals, halfH});
      EXPECT_LT(pnTangentDistance(triangle), 1e-15);
      const glm::dvec3 middle = fieldAt(triangle, 0.5, 0.5);
      EXPECT_LT(glm::length(glm::normalize(middle) - n), 1e-14);
      // With half of h every variant gives a unit normal; as printed, n110 of Farin's is 2.5 n and of the
      // corrected formula 3 n, so that the middles are (1 + 2.5 + 2.5 + 1) / 4 ... of unit length: 1.75
      // and 2.
      const double printed = normals == PnNormals::Farin            ? 1.75
                             : normals == PnNormals::CorrectedFarin ? 2.0
                                                                    : 1.0;
      EXPECT_NEAR(glm::length(middle), halfH ? 1.0 : printed, 1e-13);
    }
}

/// SC-10: the corrected field is h (or h / 2) in the middle of each side; Farin's is N1/8 + 3h/4 + N2/8.
TEST(PnTriangle, CorrectedNormalInTheMiddleOfASideIsH) {
  Random random(3);
  for (int trial = 0; trial < 50; ++trial) {
    const PnBase base = randomBase(random);
    for (const bool halfH : {false, true}) {
      const PnTriangle corrected = pnTriangle(base, {PnNormals::CorrectedFarin, halfH}),
                       farin = pnTriangle(base, {PnNormals::Farin, halfH});
      for (size_t s = 0; s < 3; ++s) {
        const size_t t = (s + 1) % 3;
        const glm::dvec3 edge = base.positions[t] - base.positions[s],
                         sum = base.normals[s] + base.normals[t];
        glm::dvec3 h = sum - 2.0 * glm::dot(sum, edge) / glm::dot(edge, edge) * edge;
        if (halfH) h *= 0.5;
        const DomainPoint at = sidePoint(Domain::Triangle, int(s), 1, 2);
        EXPECT_LT(glm::length(fieldAt(corrected, at.u, at.v) - h), 1e-13);
        EXPECT_LT(glm::length(fieldAt(farin, at.u, at.v) - (sum / 8.0 + 0.75 * h)), 1e-13);
      }
    }
  }
}

/// On a sphere with exact normals, h is in the direction of the exact normal in the middle of the edge.
TEST(PnTriangle, NormalsOnASphereAreThoseOfTheSphereAtEdges) {
  const PnBase base{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}};
  for (const PnNormals normals : {PnNormals::Linear, PnNormals::Vlachos, PnNormals::CorrectedFarin}) {
    const glm::dvec3 middle = glm::normalize(fieldAt(pnTriangle(base, {normals, false}), 0.5, 0.5));
    EXPECT_LT(glm::length(middle - glm::normalize(glm::dvec3(1, 1, 0))), 1e-14);
  }
}

/// Opposed normals and edges without length leave the formulae without a direction.
TEST(PnTriangle, FallsBackToLinearNormals) {
  const glm::dvec3 a(0), b(1, 0, 0), n(0, 0, 1), m(0.6, 0, 0.8);
  for (const PnNormals normals : {PnNormals::Vlachos, PnNormals::Farin, PnNormals::CorrectedFarin}) {
    EXPECT_EQ(pnMiddleNormal(a, b, n, -n, {normals}), glm::dvec3(0.0));
    EXPECT_EQ(pnMiddleNormal(a, a, n, m, {normals}), 0.5 * (n + m));
  }
  // One normal leans back and one forward: no inflection; both forward: one.
  EXPECT_EQ(pnMiddleNormal(a, b, {-0.6, 0, 0.8}, m, {PnNormals::LeeJen}), glm::dvec3(0, 0, 0.8));
  EXPECT_EQ(pnMiddleNormal(a, b, m, m, {PnNormals::LeeJen}),
            pnMiddleNormal(a, b, m, m, {PnNormals::Vlachos}));
}

/// SC-14: the definition, point by point: the flat point moved towards the mean of its projections.
TEST(PhongTriangle, IsTheMeanOfProjections) {
  Random random(4);
  for (const double alpha : {0.0, 0.25, 0.75, 1.0}) {
    const PnBase base = randomBase(random);
    const std::array<glm::dvec3, 6> points = phongTriangle(base, alpha);
    for (int j = 0; j <= 8; ++j)
      for (int i = 0; i + j <= 8; ++i) {
        const glm::dvec3 at(i / 8.0, j / 8.0, (8 - i - j) / 8.0);
        glm::dvec3 flat(0.0), mean(0.0);
        for (int c = 0; c < 3; ++c) flat += at[c] * base.positions[size_t(c)];
        for (int c = 0; c < 3; ++c) {
          const glm::dvec3 n = base.normals[size_t(c)];
          mean += at[c] * (flat - glm::dot(flat - base.positions[size_t(c)], n) * n);
        }
        const glm::dvec3 got = triangleJet(2, points.data(), triangleGridPoint(i, j, 8), Order::Position).p;
        EXPECT_LT(glm::length(got - ((1.0 - alpha) * flat + alpha * mean)), 1e-14);
      }
  }
}

/// A box: with creases its sides meet exactly, without them every edge of the box is a gap.
TEST(PnSet, CreasesCloseTheGapsOfABox) {
  const scene::Mesh box = scene::box({0, 0, 0}, {1, 1.2, 0.8});
  BaseMesh mesh{box.positions, box.triangles, {}};
  EXPECT_EQ(mergePositions(mesh), 0U);
  ASSERT_EQ(mesh.triangles.size(), 12U);
  computeCornerNormals(mesh, 30.0);
  // Turn the normals out of the faces, so that boundaries are curved.
  for (auto& normals : mesh.cornerNormals)
    for (size_t c = 0; c < 3; ++c) normals[c] = glm::normalize(normals[c] + glm::dvec3(0.1, 0.2, 0.3));
  PatchSet with = pnSet(mesh), without = pnSet(mesh, {{}, false});
  EXPECT_EQ(findNeighbours(with).shared, 36U);
  EXPECT_EQ(findNeighbours(with).open, 0U);
  // Only the six diagonals within faces join.
  EXPECT_EQ(findNeighbours(without).shared, 12U);
}

/// The double torus: 1,536 triangles, 2,304 edges, genus 2 (V - E + F = -2), closed, and PN boundaries join.
TEST(DoubleTorus, IsAClosedSurfaceOfGenusTwo) {
  BaseMesh mesh = scene::doubleTorus();
  EXPECT_EQ(mergePositions(mesh), 0U);
  EXPECT_EQ(mesh.triangles.size(), 1536U);
  EXPECT_EQ(mesh.positions.size(), 2304U - 1536U - 2U);
  PatchSet set = pnSet(mesh);
  const SideCounts counts = findNeighbours(set);
  EXPECT_EQ(counts.shared, 2U * 2304U);
  EXPECT_EQ(counts.open + counts.collapsed + counts.crowded, 0U);
  double volume = 0.0;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::uvec3 c = mesh.triangles[t];
    const glm::dvec3 a = mesh.positions[c.x], b = mesh.positions[c.y], d = mesh.positions[c.z];
    volume += glm::dot(a, glm::cross(b, d)) / 6.0;
    const glm::dvec3 face = glm::normalize(glm::cross(b - a, d - a));
    for (const glm::dvec3& n : mesh.cornerNormals[t]) EXPECT_GT(glm::dot(n, face), 0.7);
  }
  EXPECT_GT(volume, 0.0);
}

}  // namespace
}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
// SC-22: bicubic patches that join smoothly at extraordinary vertices.
#include "renderer/surfaces/pccm_patches.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/shapes.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/catmull_clark_point.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/normal.h"
#include "tests/renderer/surfaces/angle.h"

namespace limen::surfaces {
namespace {

/// Two caps of `valence` triangles, uneven, in quads; two steps separate their extraordinary vertices.
PolygonMesh pccmCage(uint32_t valence, int steps = 2) {
  scene::Random random(valence);
  PolygonMesh mesh;
  mesh.points = {{0, 0, 1.2}, {0, 0, -1.2}};
  for (uint32_t i = 0; i < valence; ++i) {
    const double turn = 2.0 * M_PI * i / valence, radius = random.uniform(0.8, 1.2);
    mesh.points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), random.uniform(-0.2, 0.2));
  }
  for (uint32_t i = 0; i < valence; ++i) {
    const uint32_t a = 2 + i, b = 2 + (i + 1) % valence;
    mesh.faces.push_back({0, a, b}), mesh.faces.push_back({1, b, a});
  }
  return catmullClark(std::move(mesh), steps);
}

bool isRegularFace(const MeshTopology& topology, const std::vector<uint32_t>& face) {
  for (const uint32_t v : face)
    if (topology.rings()[v].faces.size() != 4) return false;
  return true;
}

/// Patch and parameters of a place on a face.
glm::dvec3 splineAt(const PatchSet& set, uint32_t face, double u, double v) {
  const size_t part = (u < 0.5 ? 0 : 1) + (v < 0.5 ? 0 : 2);
  return evaluate(set, set.patches[4 * face + part],
                  rectanglePoint(2.0 * u - (u < 0.5 ? 0 : 1), 2.0 * v - (v < 0.5 ? 0 : 1)), Order::Position)
      .p;
}

TEST(PccmPatches, AreExactOnRegularFaces) {
  const PolygonMesh mesh = catmullClark(scene::doubleTorusCage());
  const MeshTopology topology(mesh);
  const PatchSet set = pccmPatches(mesh);
  ASSERT_EQ(set.patches.size(), 4 * mesh.faces.size());
  size_t regular = 0;
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    if (!isRegularFace(topology, mesh.faces[f])) continue;
    ++regular;
    for (const double u : {0.1, 0.5, 0.8})
      for (const double v : {0.0, 0.3, 0.9})
        EXPECT_LT(glm::length(splineAt(set, f, u, v) - catmullClarkPoint(mesh, f, u, v).position), 1e-13);
  }
  EXPECT_GT(regular, 100U);
}

/// Control point `q` of row `k`, counted from a side. Sides run as sidePoint() has them.
glm::dvec3 rowPoint(const PatchSet& set, size_t patch, int side, int k, int q) {
  const std::array<glm::ivec2, 4> at = {{{q, k}, {3 - k, q}, {3 - q, 3 - k}, {k, 3 - q}}};
  const glm::ivec2 place = at[size_t(side)];
  return glm::dvec3(set.points[set.patches[patch].firstPoint + size_t(place.x + 4 * place.y)]);
}

/// Tangent planes agree along all sides, for valences from 3 to 12; vertices have the surface's points and
/// normals. Where no extraordinary vertex of even valence lies beside, second derivatives agree as well
/// unless the side ends in one.
TEST(PccmPatches, JoinSmoothly) {
  for (const uint32_t valence : {3U, 4U, 5U, 6U, 7U, 8U, 12U}) {
    const PolygonMesh mesh = pccmCage(valence);
    const MeshTopology topology(mesh);
    const LimitPoints limit = catmullClarkLimit(mesh);
    PatchSet set = pccmPatches(mesh);
    const SideCounts counts = findNeighbours(set);
    EXPECT_EQ(counts.open + counts.crowded + counts.collapsed, 0U) << valence;
    double angle = 0.0, second = 0.0;
    size_t curvatures = 0;
    for (size_t p = 0; p < set.patches.size(); ++p) {
      const std::vector<uint32_t>& face = mesh.faces[p / 4];
      bool even = false;
      for (const uint32_t v : face) {
        const size_t n = topology.rings()[v].faces.size();
        even = even || (n != 4 && n % 2 == 0);
      }
      for (int side = 0; side < 4; ++side) {
        const Neighbour& beyond = set.neighbours[p][size_t(side)];
        ASSERT_TRUE(beyond.patch >= 0 && beyond.reversed);
        for (int q = 0; q <= 10; ++q)
          angle = std::max(
              angle,
              angleDeg(
                  geometricNormal(set, set.patches[p], sidePoint(Domain::Rectangle, side, q, 10)).direction,
                  geometricNormal(set, set.patches[size_t(beyond.patch)],
                                  sidePoint(Domain::Rectangle, beyond.side, 10 - q, 10))
                      .direction));
        // Sides between two faces of which neither end is extraordinary.
        if (size_t(beyond.patch) / 4 == p / 4 || even) continue;
        const std::vector<uint32_t>& other = mesh.faces[size_t(beyond.patch) / 4];
        bool alone = true;
        for (const uint32_t v : face)
          if (std::find(other.begin(), other.end(), v) != other.end())
            alone = alone && topology.rings()[v].faces.size() == 4;
        bool otherEven = false;
        for (const uint32_t v : other) {
          const size_t n = topology.rings()[v].faces.size();
          otherEven = otherEven || (n != 4 && n % 2 == 0);
        }
        if (!alone || otherEven) continue;
        ++curvatures;
        for (int q = 0; q < 4; ++q) {
          const auto own = [&](int k) { return rowPoint(set, p, side, k, q); };
          const auto theirs = [&](int k) {
            return rowPoint(set, size_t(beyond.patch), beyond.side, k, 3 - q);
          };
          second = std::max(second, glm::length((own(2) - 2.0 * own(1) + own(0)) -
                                                (theirs(2) - 2.0 * theirs(1) + theirs(0))));
        }
      }
    }
    EXPECT_LT(angle, 1e-5) << valence;
    EXPECT_GT(curvatures, 50U) << valence;
    EXPECT_LT(second, 1e-13) << valence;
    for (uint32_t f = 0; f < mesh.faces.size(); ++f)
      for (size_t c = 0; c < 4; ++c) {
        const size_t patch = 4 * f + (c == 0 ? 0U : c == 1 ? 1U : c == 2 ? 3U : 2U);
        const DomainPoint at = sidePoint(Domain::Rectangle, int(c), 0, 1);
        EXPECT_LT(glm::length(evaluate(set, set.patches[patch], at, Order::Position).p -
                              limit.points[mesh.faces[f][c]]),
                  1e-13);
        EXPECT_LT(angleDeg(geometricNormal(set, set.patches[patch], at).direction, limit.normals[f][c]),
                  1e-5);
      }
  }
}

/// A fourth of the distance from the surface with each step: quads at extraordinary vertices, half as wide.
TEST(PccmPatches, ComeCloserWithEachStep) {
  for (const uint32_t valence : {3U, 5U, 6U, 8U}) {
    double last = 0.0;
    for (const int steps : {2, 3}) {
      const PolygonMesh mesh = pccmCage(valence, steps);
      const PatchSet set = pccmPatches(mesh);
      double most = 0.0;
      for (uint32_t f = 0; f < mesh.faces.size(); ++f)
        for (const double u : {0.2, 0.45, 0.7})
          for (const double v : {0.15, 0.4, 0.8})
            most = std::max(most,
                            glm::length(splineAt(set, f, u, v) - catmullClarkPoint(mesh, f, u, v).position));
      double side = 0.0;
      for (const std::vector<uint32_t>& face : mesh.faces)
        for (size_t k = 0; k < 4; ++k)
          side = std::max(side, glm::length(mesh.points[face[k]] - mesh.points[face[(k + 1) % 4]]));
      // Both surfaces lie within the hulls of the vertices around a quad, two sides wide; a tenth of that.
      EXPECT_LT(most, 0.2 * side) << valence;
      // Shapes around vertices of high valence shrink by less than half a step.
      if (last > 0.0) {
        EXPECT_LT(most, 0.8 * last) << valence;
      }
      last = most;
    }
  }
}

TEST(PccmPatches, RefuseWhatTheyCannotTake) {
  EXPECT_THROW(pccmPatches(pccmCage(5, 1)), std::invalid_argument);  // 3 beside 5
  PolygonMesh fan;
  fan.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {-1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}};
  fan.faces = {{0, 1, 2, 3}, {0, 3, 4, 5}, {0, 5, 6, 7}};
  EXPECT_THROW(pccmPatches(fan), std::invalid_argument);  // three faces at a boundary
}

}  // namespace
}  // namespace limen::surfaces

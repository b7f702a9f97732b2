// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/smooth_triangles.h"

#include <gtest/gtest.h>

#include "renderer/scene/shapes.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/mesh_edges.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/normal.h"
#include "renderer/surfaces/pn_set.h"
#include "renderer/surfaces/surface_errors.h"
#include "tests/renderer/surfaces/angle.h"

namespace limen::surfaces {
namespace {

/// A closed bumpy ball, coarse enough for PN triangles to meet at visible angles.
BaseMesh ball() {
  const scene::Mesh sphere = scene::sphere(glm::dvec3(0.0), 1.0, 3);
  BaseMesh mesh{sphere.positions, sphere.triangles, {}};
  mergePositions(mesh);
  scene::Random random(5);
  for (glm::dvec3& p : mesh.positions) p *= random.uniform(0.8, 1.2);
  computeCornerNormals(mesh, 180.0);
  return mesh;
}

/// From four points near the side: differences of positions alone, with no knowledge of the construction.
glm::dvec3 normalBeside(const SmoothTriangle& triangle, int side, double t) {
  const auto at = [&](double along, double inwards) {
    std::array<double, 3> p{};
    const auto s = size_t(side);
    p[s] = (1.0 - along) * (1.0 - inwards), p[(s + 1) % 3] = along * (1.0 - inwards),
    p[(s + 2) % 3] = inwards;
    return triangle.position(p[0], p[1], p[2]);
  };
  const double h = 1e-4;
  const glm::dvec3 along = at(t + h, 0.0) - at(t - h, 0.0),
                   inwards = -3.0 * at(t, 0.0) + 4.0 * at(t, h) - at(t, 2.0 * h);
  return glm::normalize(glm::cross(along, inwards));
}

struct Gap {
  double most = 0.0;
  int compared = 0;
};
/// Angles between the tangent planes of neighbours.
Gap gapOf(const BaseMesh& mesh, const std::vector<SmoothTriangle>& triangles) {
  Gap out;
  for (const MeshEdge& edge : edgesOf(mesh.triangles)) {
    std::array<int, 2> sides{};
    for (size_t i = 0; i < 2; ++i)
      for (int s = 0; s < 3; ++s) {
        const glm::uvec3& t = mesh.triangles[edge.triangles[i]];
        if (std::min(t[s], t[(s + 1) % 3]) == edge.vertices[0] &&
            std::max(t[s], t[(s + 1) % 3]) == edge.vertices[1])
          sides[i] = s;
      }
    for (const double t : {0.03, 0.2, 0.4, 0.5, 0.77, 0.98}) {
      out.most = std::max(out.most, angleDeg(normalBeside(triangles[edge.triangles[0]], sides[0], t),
                                             normalBeside(triangles[edge.triangles[1]], sides[1], 1.0 - t)));
      ++out.compared;
    }
  }
  return out;
}

/// SC-12, SC-13: tangent planes agree across all sides to 0.1 degree; those of PN triangles do not.
TEST(SmoothTriangles, TangentPlanesAgreeAcrossSides) {
  const BaseMesh mesh = ball();
  for (const Smoothing smoothing : {Smoothing::SideVertex, Smoothing::TangentPlanes}) {
    const Gap gap = gapOf(mesh, smoothTriangles(mesh, smoothing));
    EXPECT_GT(gap.compared, 500);
    EXPECT_LT(gap.most, 0.1) << int(smoothing);
  }
  // Without neighbours the construction is the PN triangle.
  std::vector<SmoothTriangle> plain;
  for (const PnBase& base : pnBases(mesh))
    plain.emplace_back(Smoothing::TangentPlanes, base,
                       std::array<std::optional<SmoothTriangle::Beyond>, 3>{});
  EXPECT_GT(gapOf(mesh, plain).most, 5.0);
}

/// Boundaries are those of PN triangles, and the normals of a side are those that its ends' normals give.
TEST(SmoothTriangles, InterpolateBoundariesAndNormals) {
  const BaseMesh mesh = ball();
  const std::vector<PnBase> bases = pnBases(mesh);
  for (const Smoothing smoothing : {Smoothing::SideVertex, Smoothing::TangentPlanes}) {
    const std::vector<SmoothTriangle> triangles = smoothTriangles(mesh, smoothing);
    for (size_t t = 0; t < triangles.size(); t += 3) {
      const PnTriangle pn = pnTriangle(bases[t]);
      for (int side = 0; side < 3; ++side)
        for (int q = 0; q <= 8; ++q) {
          const DomainPoint at = sidePoint(Domain::Triangle, side, q, 8);
          EXPECT_LT(glm::length(triangles[t].position(at.u, at.v, at.w()) -
                                triangleJet(3, pn.points.data(), at, Order::Position).p),
                    1e-12);
          if (q == 0) {
            const glm::dvec3 normal = triangles[t].normal(at.u, at.v, at.w());
            EXPECT_LT(glm::length(normal - bases[t].normals[size_t(side)]), 1e-12);
          } else if (q < 8) {
            const double share = q / 8.0;
            EXPECT_LT(angleDeg(normalBeside(triangles[t], side, share), triangles[t].sideNormal(side, share)),
                      0.01)
                << int(smoothing);
          }
        }
      // Tangent planes at corners are across the given normals: from close by, whichever way.
      for (const double angle : {0.1, 0.5, 0.9}) {
        const double h = 1e-5;
        const glm::dvec3 near = triangles[t].normal(1.0 - h, h * angle, h * (1.0 - angle));
        EXPECT_LT(angleDeg(near, bases[t].normals[0]), 0.1);
      }
    }
  }
}

/// A flat triangle among flat ones stays flat.
TEST(SmoothTriangles, OfAPlaneAreIt) {
  BaseMesh mesh;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) mesh.positions.emplace_back(x + 0.2 * y, y, 0.5 * x - 0.25 * y);
  for (uint32_t y = 0; y < 2; ++y)
    for (uint32_t x = 0; x < 2; ++x) {
      const uint32_t a = x + 3 * y;
      mesh.triangles.insert(mesh.triangles.end(), {{a, a + 1, a + 4}, {a, a + 4, a + 3}});
    }
  computeCornerNormals(mesh, 180.0);
  for (const Smoothing smoothing : {Smoothing::SideVertex, Smoothing::TangentPlanes})
    for (const SmoothTriangle& triangle : smoothTriangles(mesh, smoothing)) {
      const glm::dvec3 a = triangle.position(1, 0, 0), b = triangle.position(0, 1, 0),
                       c = triangle.position(0, 0, 1);
      for (const double u : {0.1, 0.3, 0.5})
        for (const double v : {0.0, 0.2, 0.4})
          EXPECT_LT(glm::length(triangle.position(u, v, 1 - u - v) - (u * a + v * b + (1 - u - v) * c)),
                    1e-14);
    }
}

/// As patches: all sides have neighbours, positions and normals follow the surfaces, closer with more
/// pieces.
TEST(SmoothTriangles, BecomePatches) {
  const BaseMesh mesh = ball();
  for (const Smoothing smoothing : {Smoothing::SideVertex, Smoothing::TangentPlanes}) {
    const std::vector<SmoothTriangle> triangles = smoothTriangles(mesh, smoothing);
    double before = 1e9, normalBefore = 180.0;
    for (const int pieces : {1, 2, 4}) {
      PatchSet set = smoothSet(mesh, smoothing, pieces);
      const SideCounts counts = findNeighbours(set);
      EXPECT_EQ(counts.open + counts.crowded + counts.collapsed, 0U);
      EXPECT_EQ(set.patches.size(), triangles.size() * size_t(pieces * pieces));
      double position = 0.0, normal = 0.0;
      for (size_t t = 0; t < triangles.size(); ++t) {
        // The first piece has its w corner at the triangle's and its u towards u.
        const Patch& patch = set.patches[t * size_t(pieces * pieces)];
        for (const double u : {0.1, 0.4, 0.7})
          for (const double v : {0.05, 0.2, 0.3}) {
            const double a = u / pieces, b = v / pieces;
            const glm::dvec3 exact = triangles[t].normal(a, b, 1 - a - b);
            position =
                std::max(position, glm::length(evaluate(set, patch, trianglePoint(u, v), Order::Position).p -
                                               triangles[t].position(a, b, 1 - a - b)));
            normal = std::max(normal, angleDeg(normalAt(set, patch, trianglePoint(u, v)).direction, exact));
          }
      }
      EXPECT_LT(position, before);
      EXPECT_LT(normal, normalBefore);
      before = position, normalBefore = normal;
    }
    EXPECT_LT(before, 2e-3);
  }
}

}  // namespace
}  // namespace limen::surfaces

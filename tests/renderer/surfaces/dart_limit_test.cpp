// SPDX-License-Identifier: BSD-3-Clause
// Limits at vertices where a crease ends, against points by direct evaluation, which refines the whole mesh
// around them 40 times: what is wrong with a mask is then 2^-40 of the mesh.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/catmull_clark_point.h"
#include "renderer/surfaces/loop_point.h"
#include "renderer/surfaces/loop_subdivision.h"

namespace limen::surfaces {
namespace {

constexpr double kSharp = kInfinitelySharp;
const double kBeside = std::ldexp(1.0, -80);

/// A bumpy fan of `valence` faces around vertex 0 with two further rings, one of whose spokes is sharp up to
/// the middle.
PolygonMesh fan(int valence, bool triangles) {
  scene::Random random(valence);
  PolygonMesh mesh;
  const auto n = uint32_t(valence);
  mesh.points.emplace_back(0.0, 0.0, 0.4);
  // Rings of 2 n vertices; of triangles n.
  const uint32_t around = triangles ? n : 2 * n;
  for (int ring = 1; ring <= 3; ++ring)
    for (uint32_t i = 0; i < around; ++i) {
      const double turn = 2.0 * M_PI * i / around, radius = ring * random.uniform(0.8, 1.2);
      mesh.points.emplace_back(radius * std::cos(turn), radius * std::sin(turn), random.uniform(-0.3, 0.3));
    }
  const auto at = [&](uint32_t ring, uint32_t i) { return 1 + ring * around + i % around; };
  for (uint32_t i = 0; i < n; ++i) {
    if (triangles) {
      mesh.faces.push_back({0, at(0, i), at(0, i + 1)});
    } else {
      mesh.faces.push_back({0, at(0, 2 * i), at(0, 2 * i + 1), at(0, 2 * i + 2)});
    }
  }
  for (uint32_t ring = 0; ring < 2; ++ring)
    for (uint32_t i = 0; i < around; ++i) {
      const uint32_t a = at(ring, i), b = at(ring + 1, i), c = at(ring + 1, i + 1), d = at(ring, i + 1);
      if (triangles) {
        mesh.faces.push_back({a, b, c}), mesh.faces.push_back({a, c, d});
      } else {
        mesh.faces.push_back({a, b, c, d});
      }
    }
  mesh.sharpness[edgeKey(0, at(0, 0))] = kSharp;
  mesh.sharpness[edgeKey(at(0, 0), at(1, 0))] = kSharp;
  mesh.sharpness[edgeKey(at(1, 0), at(2, 0))] = kSharp;
  return mesh;
}

void expectLimit(const PolygonMesh& mesh, const glm::dvec3& limit, const LimitPoint& exact,
                 const LimitPoint& beside, glm::dvec3 normal, int valence) {
  EXPECT_LT(glm::length(limit - exact.position), 1e-9) << valence;
  EXPECT_GT(glm::length(limit - mesh.points[0]), 0.01) << valence;  // it does move
  // Of a vertex of valence 8 Catmull-Clark's rules leave more than two directions that shrink by a half, and
  // no plane.
  if (valence > 7) return;
  // 80 steps away the ring has taken its plane but for (0.4619 / 0.5)^80 = 0.0018 (valence 7): 0.1 degrees,
  // in both.
  EXPECT_GT(glm::dot(normal, beside.normal), std::cos(glm::radians(0.2))) << valence;
}

TEST(DartLimit, IsWhereCatmullClarkStepsLead) {
  for (int valence = 3; valence <= 8; ++valence) {
    const PolygonMesh mesh = fan(valence, false);
    const LimitPoints limit = catmullClarkLimit(mesh);
    expectLimit(mesh, limit.points[0], catmullClarkPoint(mesh, 0, 0.0, 0.0),
                catmullClarkPoint(mesh, 0, kBeside, kBeside, 120), limit.normals[0][0], valence);
  }
}

TEST(DartLimit, IsWhereLoopStepsLead) {
  for (int valence = 3; valence <= 8; ++valence) {
    const PolygonMesh mesh = fan(valence, true);
    const LoopLimit limit = loopLimit(mesh);
    expectLimit(mesh, limit.points[0], loopPoint(mesh, 0, 1.0, 0.0), loopPoint(mesh, 0, 1.0 - 2e-6, 1e-6),
                limit.normals[0][0], valence);
  }
}

}  // namespace
}  // namespace limen::surfaces

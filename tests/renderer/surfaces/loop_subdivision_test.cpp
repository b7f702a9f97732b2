// SPDX-License-Identifier: BSD-3-Clause
// Loop's subdivision, its points and the quadratic patches, against repeated subdivision.
#include "renderer/surfaces/loop_subdivision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "renderer/scene/shapes.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/loop_point.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/normal.h"
#include "renderer/surfaces/qas_patches.h"
#include "tests/renderer/surfaces/rings.h"

namespace limen::surfaces {
namespace {

/// A bumpy fan of triangles around vertex 0; `open`: a half turn of them.
PolygonMesh triangleFan(int valence, bool open, scene::Random& random) {
  PolygonMesh mesh;
  mesh.points.emplace_back(0.0, 0.0, random.uniform(-0.3, 0.3));
  const int spokes = open ? valence + 1 : valence;
  for (int i = 0; i < spokes; ++i) {
    const double turn = (open ? M_PI : 2.0 * M_PI) * i / valence;
    mesh.points.emplace_back(std::cos(turn), std::sin(turn), random.uniform(-0.3, 0.3));
  }
  for (int i = 0; i < valence; ++i)
    mesh.faces.push_back({0, uint32_t(1 + i), uint32_t(1 + (i + 1) % spokes)});
  return mesh;
}

PolygonMesh closerTriangles(const PolygonMesh& mesh) { return ringOfFirst(loop(mesh)); }
PolygonMesh enlargedTriangles(PolygonMesh mesh, int steps) {
  return enlargedRingOfFirst(
      std::move(mesh), steps, [](const PolygonMesh& coarse) { return loop(coarse); },
      [](const PolygonMesh& ring) { return loopLimit(ring); });
}

/// SC-19: valences 3 to 12, inner vertices and boundaries with 1 to 12 faces.
TEST(Loop, LimitPositionIsThatOfManySteps) {
  scene::Random random(6);
  for (const bool open : {false, true})
    for (int valence = open ? 1 : 3; valence <= 12; ++valence) {
      PolygonMesh mesh = triangleFan(valence, open, random);
      const glm::dvec3 limit = loopLimit(mesh).points[0];
      for (int step = 0; step < 60; ++step) mesh = closerTriangles(mesh);
      EXPECT_LT(glm::length(mesh.points[0] - limit), 1e-9) << (open ? "boundary " : "valence ") << valence;
    }
}

TEST(Loop, LimitNormalIsThatOfManySteps) {
  scene::Random random(8);
  for (int valence = 3; valence <= 12; ++valence) {
    PolygonMesh mesh = triangleFan(valence, false, random);
    const glm::dvec3 normal = loopLimit(mesh).normals[0][0];
    mesh = enlargedTriangles(mesh, 150);
    glm::dvec3 area(0.0);
    for (const std::vector<uint32_t>& f : mesh.faces)
      area += glm::cross(mesh.points[f[1]] - mesh.points[f[0]], mesh.points[f[2]] - mesh.points[f[0]]);
    EXPECT_LT(glm::length(glm::normalize(area) - normal), 1e-6) << valence;
  }
}

/// At a boundary the normal is across its tangent and the direction in which the inner edges arrive.
TEST(Loop, LimitNormalOfABoundaryIsThatOfManySteps) {
  scene::Random random(9);
  for (int faces = 2; faces <= 12; ++faces) {
    PolygonMesh mesh = triangleFan(faces, true, random);
    const glm::dvec3 along = mesh.points[1] - mesh.points[size_t(faces) + 1];
    const LoopLimit limit = loopLimit(mesh);
    // Two faces: across the boundary everything shrinks faster than along it.
    mesh = enlargedTriangles(mesh, faces == 2 ? 40 : 300);
    glm::dvec3 inwards(0.0);
    for (size_t v = 1; v < mesh.points.size(); ++v) inwards += mesh.points[v] - mesh.points[0];
    const glm::dvec3 normal = glm::normalize(glm::cross(along, inwards));
    EXPECT_LT(glm::length(normal - limit.normals[0][0]), 1e-6) << faces;
  }
}

TEST(Loop, RefusesWhatIsNoTriangle) {
  EXPECT_THROW(loop(PolygonMesh{std::vector<glm::dvec3>(4), {{0, 1, 2, 3}}, {}}), std::invalid_argument);
}

/// A sphere's triangles, bumpy, of valences 4 and 6; `sharpness` along the equator.
PolygonMesh ball(int rings, double sharpness) {
  const scene::Mesh sphere = scene::sphere(glm::dvec3(0.0), 1.0, rings);
  scene::Random random(5);
  PolygonMesh mesh;
  for (const glm::dvec3& p : sphere.positions) mesh.points.push_back(p * random.uniform(0.7, 1.3));
  for (const glm::uvec3& t : sphere.triangles) mesh.faces.push_back({t.x, t.y, t.z});
  if (sharpness > 0.0) {
    const MeshTopology topology(mesh);
    for (const auto& [edge, sides] : topology.edges())
      if (std::abs(sphere.positions[edge[0]].y) + std::abs(sphere.positions[edge[1]].y) < 1e-9)
        mesh.sharpness[edge] = sharpness;
  }
  return mesh;
}

/// SC-21: at every vertex of the mesh after three steps, which are found by following the children's corners.
TEST(LoopPoint, IsTheLimitOfSubdivision) {
  for (const double sharpness : {0.0, 1.5, kInfinitelySharp}) {
    const PolygonMesh mesh = ball(2, sharpness), fine = loop(mesh, 3);
    const LoopLimit limit = loopLimit(fine);
    size_t checked = 0;
    for (uint32_t face = 0; face < mesh.faces.size(); face += 3)
      for (uint32_t child = 0; child < 64; ++child) {
        std::array<glm::dvec3, 3> corners = {glm::dvec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        for (int level = 2; level >= 0; --level) {
          const uint32_t which = (child >> (2 * level)) & 3U;
          const std::array<glm::dvec3, 3> middles = {0.5 * (corners[0] + corners[1]),
                                                     0.5 * (corners[1] + corners[2]),
                                                     0.5 * (corners[2] + corners[0])};
          if (which == 3)
            corners = middles;
          else
            corners = {corners[which], middles[which], middles[(which + 2) % 3]};
        }
        const LimitPoint point = loopPoint(mesh, face, corners[0].x, corners[0].y);
        EXPECT_LT(glm::length(point.position - limit.points[fine.faces[64 * face + child][0]]), 1e-9)
            << face << ' ' << child << " sharpness " << sharpness;
        ++checked;
      }
    EXPECT_GT(checked, 600U);
  }
}

/// Normals at parameters that subdivision does not reach.
TEST(LoopPoint, NormalsAreThoseOfDifferences) {
  const PolygonMesh mesh = ball(2, 0.0);
  scene::Random random(4);
  for (int k = 0; k < 40; ++k) {
    const auto face = uint32_t(random.uniform(0.0, 31.999));
    double u = random.uniform(0.05, 0.9), v = random.uniform(0.05, 0.9);
    if (u + v > 0.95) u = 0.95 - u, v = 0.95 - v;
    if (u < 0.01 || v < 0.01) continue;
    const auto at = [&](double du, double dv) { return loopPoint(mesh, face, u + du, v + dv).position; };
    const double h = 1e-5;
    const glm::dvec3 normal = glm::normalize(glm::cross(at(h, 0) - at(-h, 0), at(0, h) - at(0, -h)));
    EXPECT_LT(glm::length(normal - loopPoint(mesh, face, u, v).normal), 1e-6);
  }
}

/// SC-25: the six points of each patch are limits of the surface, its sides are shared, and its error falls
/// with the mesh.
TEST(QasPatches, InterpolateSixPointsAndComeCloserToTheSurface) {
  double last = 1.0;
  PolygonMesh mesh = ball(2, 0.0);
  for (int level = 0; level < 3; ++level) {
    PatchSet set = qasPatches(mesh);
    EXPECT_EQ(findNeighbours(set).shared, 3U * mesh.faces.size());
    double most = 0.0;
    for (uint32_t f = 0; f < mesh.faces.size(); f += 3)
      for (int j = 0; j <= 8; ++j)
        for (int i = 0; i + j <= 8; ++i) {
          const DomainPoint at = triangleGridPoint(i, j, 8);
          const LimitPoint point = loopPoint(mesh, f, at.u, at.v);
          const double distance = glm::length(evaluate(set, set.patches[f], at).p - point.position);
          most = std::max(most, distance);
          if (i % 4 == 0 && j % 4 == 0) {
            EXPECT_LT(distance, 1e-9);
            EXPECT_LT(glm::length(normalAt(set, set.patches[f], at).direction - point.normal), 1e-6);
          }
        }
    // At vertices of valence 4 the map of parameters to the surface shrinks by 3/8 a step, elsewhere the
    // error by 1/8.
    EXPECT_LT(most, 0.4 * last) << level;
    last = most, mesh = loop(mesh);
  }
  EXPECT_LT(last, 0.01);
}

}  // namespace
}  // namespace limen::surfaces

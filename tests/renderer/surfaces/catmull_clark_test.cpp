// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/catmull_clark.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/scene/shapes.h"
#include "tests/renderer/surfaces/rings.h"

namespace limen::surfaces {
namespace {

/// A fan of `valence` quads around vertex 0, bumpy, two rings of them so that the inner ones are regular but
/// for the middle. `open` leaves one sector out.
PolygonMesh fan(int valence, bool open, scene::Random& random) {
  PolygonMesh mesh;
  const int spokes = open ? valence + 1 : valence;
  const auto turn = [&](double i) { return (open ? M_PI : 2.0 * M_PI) * i / valence; };
  const auto add = [&](double radius, double i) {
    mesh.points.emplace_back(radius * std::cos(turn(i)), radius * std::sin(turn(i)),
                             random.uniform(-0.3, 0.3));
    return uint32_t(mesh.points.size() - 1);
  };
  add(0.0, 0.0);
  std::vector<uint32_t> edge, diagonal;
  for (int i = 0; i < spokes; ++i) edge.push_back(add(1.0, i));
  for (int i = 0; i < valence; ++i) diagonal.push_back(add(1.4, i + 0.5));
  for (int i = 0; i < valence; ++i)
    mesh.faces.push_back({0, edge[size_t(i)], diagonal[size_t(i)], edge[size_t((i + 1) % spokes)]});
  return mesh;
}

PolygonMesh closerRing(const PolygonMesh& mesh) { return ringOfFirst(catmullClark(mesh)); }
PolygonMesh enlargedRing(PolygonMesh mesh, int steps) {
  return enlargedRingOfFirst(
      std::move(mesh), steps, [](const PolygonMesh& coarse) { return catmullClark(coarse); },
      [](const PolygonMesh& ring) { return catmullClarkLimit(ring); });
}

/// SC-19: vertices after many steps come to where the limit masks put them, valences 3 to 12, inner vertices
/// and boundaries with 1 to 12 faces.
TEST(CatmullClark, LimitPositionIsThatOfManySteps) {
  scene::Random random(6);
  for (const bool open : {false, true})
    for (int valence = open ? 1 : 3; valence <= 12; ++valence) {
      PolygonMesh mesh = fan(valence, open, random);
      const glm::dvec3 limit = catmullClarkLimit(mesh).points[0];
      for (int step = 0; step < 60; ++step) mesh = closerRing(mesh);
      EXPECT_LT(glm::length(mesh.points[0] - limit), 1e-9) << (open ? "boundary " : "valence ") << valence;
    }
}

/// The area vector of the tiny ring around an inner vertex has the direction of the limit normal.
TEST(CatmullClark, LimitNormalIsThatOfManySteps) {
  scene::Random random(8);
  for (int valence = 3; valence <= 12; ++valence) {
    PolygonMesh mesh = fan(valence, false, random);
    const glm::dvec3 normal = catmullClarkLimit(mesh).normals[0][0];
    mesh = enlargedRing(mesh, 200);
    glm::dvec3 area(0.0);
    for (const std::vector<uint32_t>& f : mesh.faces)
      area += glm::cross(mesh.points[f[1]] - mesh.points[f[0]], mesh.points[f[3]] - mesh.points[f[0]]);
    EXPECT_LT(glm::length(glm::normalize(area) - normal), 1e-6) << valence;
  }
}

/// At a boundary the normal is across its tangent and the direction in which the inner edges arrive.
TEST(CatmullClark, LimitNormalOfABoundaryIsThatOfManySteps) {
  scene::Random random(9);
  for (int faces = 2; faces <= 12; ++faces) {
    PolygonMesh mesh = fan(faces, true, random);
    const glm::dvec3 along = mesh.points[1] - mesh.points[size_t(faces) + 1];
    const LimitPoints limit = catmullClarkLimit(mesh);
    mesh = enlargedRing(mesh, 300);
    glm::dvec3 inwards(0.0);
    for (const std::vector<uint32_t>& f : mesh.faces) inwards += mesh.points[f[2]] - mesh.points[0];
    const glm::dvec3 normal = glm::normalize(glm::cross(along, inwards));
    EXPECT_LT(glm::length(normal - limit.normals[0][0]), 1e-6) << faces;
  }
}

/// The refined mesh has the same limit as the mesh.
TEST(CatmullClark, StepsKeepTheLimit) {
  const PolygonMesh cage = scene::doubleTorusCage(), fine = catmullClark(cage);
  const LimitPoints before = catmullClarkLimit(cage), after = catmullClarkLimit(fine);
  for (size_t v = 0; v < cage.points.size(); ++v)
    EXPECT_LT(glm::length(before.points[v] - after.points[v]), 1e-14);
  for (size_t f = 0; f < cage.faces.size(); ++f)
    for (size_t c = 0; c < 4; ++c)
      EXPECT_LT(glm::length(before.normals[f][c] - after.normals[4 * f + c][0]), 1e-12);
}

/// A regular grid of a plane stays a plane, and its parameters stay evenly spaced: the B-spline of a linear
/// function is that function.
TEST(CatmullClark, OfALinearGridIsLinear) {
  PolygonMesh mesh;
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 5; ++x) mesh.points.emplace_back(x, y, 2.0 * x - y);
  for (uint32_t y = 0; y < 4; ++y)
    for (uint32_t x = 0; x < 4; ++x)
      mesh.faces.push_back({x + 5 * y, x + 1 + 5 * y, x + 6 + 5 * y, x + 5 + 5 * y});
  const PolygonMesh fine = catmullClark(mesh, 2);
  EXPECT_EQ(fine.faces.size(), 256U);
  for (const glm::dvec3& p : fine.points) EXPECT_NEAR(p.z, 2.0 * p.x - p.y, 1e-13);
  EXPECT_LT(glm::length(fine.points[12] - mesh.points[12]), 1e-14);
}

PolygonMesh cube() {
  PolygonMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  mesh.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

/// All edges infinitely sharp: a cube stays a cube; four edges around a face: that face's boundary is the
/// crease curve of its square, (1/8, 6/8, 1/8) at its corners.
TEST(CatmullClark, SharpEdgesStaySharp) {
  PolygonMesh mesh = cube();
  const MeshTopology topology(mesh);
  for (const auto& [edge, sides] : topology.edges()) mesh.sharpness[edge] = kInfinitelySharp;
  const PolygonMesh fine = catmullClark(mesh, 3);
  for (const glm::dvec3& p : fine.points)
    EXPECT_NEAR(std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}), 1.0, 1e-15);
  for (size_t v = 0; v < 8; ++v) EXPECT_EQ(fine.points[v], mesh.points[v]);

  mesh.sharpness.clear();
  for (const EdgeKey edge : {edgeKey(0, 1), edgeKey(1, 3), edgeKey(3, 2), edgeKey(2, 0)})
    mesh.sharpness[edge] = kInfinitelySharp;
  const PolygonMesh creased = catmullClark(mesh);
  // Corner (-1, -1, -1) with (1, -1, -1) and (-1, 1, -1).
  EXPECT_LT(glm::length(creased.points[0] - glm::dvec3(-0.75, -0.75, -1.0)), 1e-15);
  // Normals on both sides of the crease differ, on the same side they do not.
  const LimitPoints limit = catmullClarkLimit(creased);
  EXPECT_LT(glm::dot(limit.normals[0][0], limit.normals[8][0]), 0.99);
}

/// Sharpness 1 is one sharp step; 0.5 is half way between the sharp and the smooth step; 0 is smooth.
TEST(CatmullClark, SemiSharpEdgesAreBlended) {
  PolygonMesh mesh = cube();
  const auto withSharpness = [&](double s) {
    mesh.sharpness.clear();
    for (const EdgeKey edge : {edgeKey(0, 1), edgeKey(1, 3), edgeKey(3, 2), edgeKey(2, 0)})
      mesh.sharpness[edge] = s;
    return catmullClark(mesh);
  };
  const PolygonMesh smooth = withSharpness(0.0), half = withSharpness(0.5), sharp = withSharpness(1.0),
                    infinite = withSharpness(kInfinitelySharp);
  for (size_t v = 0; v < smooth.points.size(); ++v) {
    EXPECT_LT(glm::length(half.points[v] - 0.5 * (smooth.points[v] + sharp.points[v])), 1e-15);
    EXPECT_EQ(sharp.points[v], infinite.points[v]);
  }
  EXPECT_TRUE(sharp.sharpness.empty());
  EXPECT_EQ(infinite.sharpness.size(), 8U);
}

TEST(CatmullClark, RefusesWhatItCannotRefine) {
  PolygonMesh bowTie;
  bowTie.points.resize(5);
  bowTie.faces = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_THROW(MeshTopology{bowTie}, std::invalid_argument);
  PolygonMesh twice;
  twice.points.resize(4);
  twice.faces = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_THROW(MeshTopology{twice}, std::invalid_argument);
  EXPECT_THROW(catmullClarkLimit(PolygonMesh{std::vector<glm::dvec3>(3), {{0, 1, 2}}, {}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace limen::surfaces

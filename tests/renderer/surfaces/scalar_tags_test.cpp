// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/scalar_tags.h"

#include <gtest/gtest.h>

#include "renderer/scene/shapes.h"
#include "renderer/surfaces/inherent_gaps.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/pn_set.h"

namespace limen::surfaces {
namespace {

/// A roof whose ridge runs along y: two squares that meet at 90 degrees, faces (-1, 0, 1) and (1, 0, 1).
BaseMesh roof() {
  BaseMesh mesh;
  mesh.positions = {{-1, 0, -1}, {0, 0, 0}, {0, 1, 0}, {-1, 1, -1}, {1, 0, -1}, {1, 1, -1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  return mesh;
}

BaseMesh tagged(const ScalarTags& tags) {
  BaseMesh mesh = roof();
  tagCornerNormals(mesh, 60.0, tags);
  return mesh;
}

/// Angle of the normals at the middle of the ridge's end from the vertical, on the left and the right
/// [degree].
glm::dvec2 turnsAtRidge(const BaseMesh& mesh) {
  const auto turn = [](glm::dvec3 n) { return glm::degrees(std::atan2(n.x, n.z)); };
  // Vertex 2: corner 2 of triangle 0, and of triangle 3.
  return {turn(mesh.cornerNormals[0][2]), turn(mesh.cornerNormals[3][2])};
}

TEST(ScalarTags, SharpnessTurnsNormalsFromTheMeanToTheFaces) {
  // Two triangles meet at vertex 2 on the left and one on the right, with equal sums of angles: the mean is
  // up.
  EXPECT_LT(glm::length(turnsAtRidge(tagged({0.0, 0.0}))), 1e-12);
  const glm::dvec2 sharp = turnsAtRidge(tagged({1.0, 0.0}));
  EXPECT_NEAR(sharp.x, -45.0, 1e-9);
  EXPECT_NEAR(sharp.y, 45.0, 1e-9);
  // Half way along the chord from (0, 1) to (sin 45, cos 45).
  const double half = glm::degrees(std::atan2(std::sqrt(0.5), 1.0 + std::sqrt(0.5)));
  EXPECT_NEAR(turnsAtRidge(tagged({0.5, 0.0})).y, half, 1e-9);
  EXPECT_NEAR(turnsAtRidge(tagged({0.5, 0.0})).x, -half, 1e-9);
}

TEST(ScalarTags, BiasLeavesTheTurnToOneSide) {
  // Half of the difference between the faces' normals, (-sqrt 2, 0), is added to both: that of one side,
  // (-sqrt 1/2, sqrt 1/2), doubles its slope, that of the other becomes upright.
  const glm::dvec2 left = turnsAtRidge(tagged({1.0, 1.0})), right = turnsAtRidge(tagged({1.0, -1.0}));
  const double doubled = glm::degrees(std::atan2(std::sqrt(2.0), std::sqrt(0.5)));
  EXPECT_NEAR(left.x, -doubled, 1e-9);
  EXPECT_NEAR(left.y, 0.0, 1e-9);
  EXPECT_NEAR(right.x, 0.0, 1e-9);
  EXPECT_NEAR(right.y, doubled, 1e-9);
}

TEST(ScalarTags, WithoutTagsTheyArePnTriangles) {
  const scene::Mesh sphere = scene::sphere(glm::dvec3(0.0), 1.0, 2);
  BaseMesh plain{sphere.positions, sphere.triangles, {}};
  mergePositions(plain);
  BaseMesh tags = plain;
  computeCornerNormals(plain, 180.0);
  tagCornerNormals(tags, 80.0, {1.0, 0.0});
  EXPECT_EQ(plain.cornerNormals, tags.cornerNormals);
  const PatchSet a = pnSet(plain), b = pnSet(tags, {{PnNormals::Linear, false, 0.0}, true});
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.normals, b.normals);
}

/// Tension 1 shortens all tangents to nothing: sides become straight. Sharp edges stay closed at any tension.
TEST(ScalarTags, TensionFlattensSides) {
  for (const double tension : {0.0, 0.5, 1.0}) {
    PatchSet set = pnSet(tagged({0.7, 0.0}), {{PnNormals::Linear, false, tension}, true});
    EXPECT_TRUE(inherentGaps(set).empty());
    EXPECT_EQ(findNeighbours(set).shared, 6U);
    // Control points of the ridge: that next to vertex 1 in triangle 0, at a third of the edge untagged.
    const auto base = pnBases(tagged({0.7, 0.0}));
    const PnTriangle triangle = pnTriangle(base[0], {PnNormals::Linear, false, tension});
    EXPECT_NEAR(glm::length(triangle.points[7] - base[0].positions[1]), (1.0 - tension) / 3.0, 1e-12);
  }
}

}  // namespace
}  // namespace limen::surfaces

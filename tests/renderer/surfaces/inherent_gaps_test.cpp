// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/inherent_gaps.h"

#include <gtest/gtest.h>

#include "renderer/scene/shapes.h"
#include "renderer/surfaces/pn_set.h"

namespace limen::surfaces {
namespace {

/// A box whose corner normals lean away from the faces: each of its twelve edges is a gap, the six diagonals
/// and edges whose curves follow the crease are none.
TEST(InherentGaps, AreTheEdgesOfABox) {
  const scene::Mesh box = scene::box({0, 0, 0}, {1, 1.2, 0.8});
  BaseMesh mesh{box.positions, box.triangles, {}};
  mergePositions(mesh);
  computeCornerNormals(mesh, 30.0);
  for (auto& normals : mesh.cornerNormals)
    for (size_t c = 0; c < 3; ++c) normals[c] = glm::normalize(normals[c] + glm::dvec3(0.1, 0.2, 0.3));
  const PatchSet open = pnSet(mesh, {{}, false}), closed = pnSet(mesh);
  const std::vector<InherentGap> gaps = inherentGaps(open);
  EXPECT_EQ(gaps.size(), 12U);
  for (const InherentGap& gap : gaps) {
    EXPECT_LT(gap.patches[0], gap.patches[1]);
    for (const size_t i : {0U, 1U}) EXPECT_LT(open.neighbours[gap.patches[i]][size_t(gap.sides[i])].patch, 0);
  }
  EXPECT_TRUE(inherentGaps(closed).empty());
}

/// A triangle in the plane z = 0 with a straight side along x, and one that hangs down from it. Normals of
/// the second at the common ends decide how its curve leaves the edge: `out` in the plane of the first, away
/// from it; otherwise in its own plane, downwards.
BaseMesh bracket(bool out, bool swapped) {
  BaseMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0}, {0.5, 0, -1}};
  const glm::dvec3 up(0, 0, 1), front(0, -1, 0);
  // Normals that lean along the edge, one to either end, move tangent points along themselves.
  const glm::dvec3 away = out ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 left = glm::normalize(glm::dvec3(0.5, 0, 0) + away),
                   right = glm::normalize(glm::dvec3(-0.5, 0, 0) + away);
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  mesh.cornerNormals = {{up, up, up}, {right, left, front}};
  if (swapped)
    std::swap(mesh.triangles[0], mesh.triangles[1]), std::swap(mesh.cornerNormals[0], mesh.cornerNormals[1]);
  return mesh;
}

TEST(InherentGaps, TakeTheNormalsOfTheFaceThatTheStripContinues) {
  for (const bool out : {false, true})
    for (const bool swapped : {false, true}) {
      const std::vector<InherentGap> gaps = inherentGaps(pnSet(bracket(out, swapped), {{}, false}));
      ASSERT_EQ(gaps.size(), 1U);
      // The triangle in the plane z = 0 where the strip lies in it.
      EXPECT_EQ(gaps[0].normalsFrom, out == swapped ? 1 : 0) << out << swapped;
    }
}

/// An edge of three triangles, and two triangles that are turned against each other, are left alone.
TEST(InherentGaps, NeedTwoSidesOfOppositeDirections) {
  BaseMesh mesh = bracket(true, false);
  mesh.positions.push_back({0.5, -1, 0.5});
  mesh.triangles.push_back({1, 0, 4});
  mesh.cornerNormals.push_back(mesh.cornerNormals[1]);
  for (glm::dvec3& n : mesh.cornerNormals[2]) n = glm::normalize(n + glm::dvec3(0.3, 0, 0.1));
  EXPECT_TRUE(inherentGaps(pnSet(mesh, {{}, false})).empty());
  mesh = bracket(true, false);
  mesh.triangles[1] = {0, 1, 3};
  EXPECT_TRUE(inherentGaps(pnSet(mesh, {{}, false})).empty());
}

}  // namespace
}  // namespace limen::surfaces

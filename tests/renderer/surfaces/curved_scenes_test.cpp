// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/curved/teapot.h"
#include "renderer/surfaces/neighbours.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

using surfaces::PatchSet;

/// Of the 128 sides 8 are poles (knob and bottom), and 16 are the free ends of rim, lid, handle and spout.
TEST(Teapot, HasTheNeighboursOfItsPieces) {
  PatchSet set = teapot();
  EXPECT_EQ(set.patches.size(), 32U);
  const surfaces::SideCounts counts = surfaces::findNeighbours(set);
  EXPECT_EQ(counts.collapsed, 8U);
  EXPECT_EQ(counts.open, 16U);
  EXPECT_EQ(counts.crowded, 0U);
  EXPECT_EQ(counts.shared, 104U);
  for (const auto& sides : set.neighbours)
    for (const surfaces::Neighbour& side : sides) EXPECT_TRUE(side.patch < 0 || side.reversed);
}

/// Its measures as everyone knows them: 3.15 high, 6.525 from handle to spout (3 + 3.525 are control points,
/// the surface reaches a little less), 4 wide.
TEST(Teapot, HasNewellsMeasures) {
  const Mesh mesh = patchMesh(teapot(), 32);
  Bounds bounds;
  for (const glm::dvec3& p : mesh.positions) bounds.extend(p);
  EXPECT_EQ(bounds.low.y, 0.0);
  EXPECT_EQ(bounds.high.y, 3.15);
  EXPECT_NEAR(bounds.high.z, 2.0, 1e-3);
  EXPECT_NEAR(bounds.low.z, -2.0, 1e-3);
  EXPECT_NEAR(bounds.low.x, -3.0, 0.01);
  EXPECT_NEAR(bounds.high.x, 3.43, 0.01);
}

TEST(Teapot, HasUnitNormalsAtItsPolesAndSaysHow) {
  surfaces::NormalHistogram histogram{};
  const Mesh mesh = patchMesh(teapot(), 8, &histogram);
  for (const glm::vec3& normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1.0F, 1e-6F);
  // Poles are 8 sides of 9 vertices.
  EXPECT_EQ(histogram[size_t(surfaces::NormalRung::Limit)], 72U);
  EXPECT_EQ(histogram[size_t(surfaces::NormalRung::Tangents)], mesh.normals.size() - 72U);
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    if (mesh.positions[i] == glm::dvec3(0.0, 3.15, 0.0)) {
      EXPECT_NEAR(mesh.normals[i].y, 1.0F, 1e-6F);
    }
    if (mesh.positions[i] == glm::dvec3(0.0)) {
      EXPECT_NEAR(mesh.normals[i].y, -1.0F, 1e-6F);
    }
  }
}

/// Body and lid are seen from their axis, handle and spout from the middle of their nearest cross-section.
TEST(Teapot, FacesOutwards) {
  const PatchSet set = teapot();
  for (size_t p = 0; p < 24; ++p) {
    const surfaces::SurfaceNormal normal =
        surfaces::normalAt(set, set.patches[p], surfaces::rectanglePoint(0.5, 0.5));
    const glm::dvec3 at = surfaces::evaluate(set, set.patches[p], surfaces::rectanglePoint(0.5, 0.5)).p;
    const bool rim = p / 4 == 3, bottom = p / 4 == 0, lid = p / 4 == 4;
    const glm::dvec3 out = rim      ? glm::dvec3(0, 1, 0)
                           : bottom ? glm::dvec3(0, -1, 0)
                           : lid    ? glm::dvec3(0, 1, 0)
                                    : glm::dvec3(at.x, 0, at.z);
    EXPECT_GT(glm::dot(normal.direction, out), 0.0) << p;
  }
  for (size_t p = 24; p < 32; ++p) {
    const glm::dvec3 at = surfaces::evaluate(set, set.patches[p], surfaces::rectanglePoint(0.5, 0.5)).p;
    const surfaces::SurfaceNormal normal =
        surfaces::normalAt(set, set.patches[p], surfaces::rectanglePoint(0.5, 0.5));
    EXPECT_GT(normal.direction.z * at.z, 0.0) << p;
  }
}

/// The triangles' winding agrees with the normals.
TEST(PatchMesh, TrianglesFaceTheWayOfTheirNormals) {
  const Mesh mesh = patchMesh(teapot(), 16);
  // Thin ones at the poles are left out: 8 sides lose one triangle a segment.
  EXPECT_EQ(mesh.triangles.size(), 32U * 2 * 16 * 16 - 8 * 16);
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    const glm::dvec3 normal = mesh.normals[t.x] + mesh.normals[t.y] + mesh.normals[t.z];
    ASSERT_GT(glm::dot(glm::cross(b - a, c - a), normal), 0.0);
  }
}

/// The counts of Schwarz 2009, Tables 7.1, 7.4 and 7.6.
TEST(CurvedScenes, HaveThePatchesOfTheThesis) {
  const auto patches = [](const std::string& name, fixtures::Given given) {
    return fixtures::build(name, std::move(given)).surfaces;
  };
  const fixtures::Given coarse{{"tessellation", int64_t{1}}};
  EXPECT_EQ(patches("curved/double_torus", coarse).patches.size(), 1536U);
  EXPECT_EQ(
      buildScene("curved/star_field",
                 ParameterValues(SceneRegistry::instance().get("curved/star_field").allParameters(), coarse))
          .surfaces.patches.size(),
      41496U);
  EXPECT_EQ(patches("curved/tea_table", coarse).patches.size(), 332U);
  EXPECT_EQ(patches("curved/spheres", coarse).patches.size(), 32000U);
  PatchSet herd = patches("curved/herd", {{"tessellation", int64_t{1}}, {"animals", int64_t{8}}});
  EXPECT_EQ(herd.patches.size(), 92256U);
  // Ten closed tubes an animal: only their tips are not shared.
  const surfaces::SideCounts counts = surfaces::findNeighbours(herd);
  EXPECT_EQ(counts.open + counts.crowded, 0U);
  EXPECT_EQ(counts.collapsed, 8U * 2U * (96 + 31 + 31 + 31 + 31 + 31 + 4 * 20));
  EXPECT_EQ(counts.shared, 4U * 92256U - counts.collapsed);
}

TEST(CurvedScenes, HoldTheirPatchesAndSayTheyAreCurved) {
  for (const std::string& name : SceneRegistry::instance().names()) {
    if (name.rfind("curved/", 0) != 0 || !fixtures::installed(name)) continue;
    SCOPED_TRACE(name);
    const Scene scene = fixtures::build(name);
    // Control meshes of subdivision surfaces need no patches.
    EXPECT_TRUE(scene.traits().contains("curved_surfaces") || !scene.subdivisions.empty());
    EXPECT_EQ(scene.surfaces.neighbours.size(), scene.surfaces.patches.size());
    for (const surfaces::Patch& patch : scene.surfaces.patches) {
      ASSERT_LT(patch.part, scene.parts.size());
      ASSERT_FALSE(scene.parts[patch.part].receiverOnly);
    }
  }
}

}  // namespace
}  // namespace limen::scene

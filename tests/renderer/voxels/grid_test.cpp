// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/voxels/exact_attributes.h"
#include "renderer/voxels/exact_voxels.h"
#include "tests/renderer/voxels/clipped_triangle.h"

namespace limen::voxels {
namespace {

// Sizes printed in Gaitatzes 2012, Table 3, from boxes with the proportions of their largest grids, each
// known to half a voxel of 512 only.
TEST(VoxelGrid, HasTheSizesOfTheThesis) {
  struct Row {
    glm::dvec3 proportions;
    glm::ivec3 sizes[4];  // 64 to 512
  };
  const Row rows[] = {
      {{425.2, 512, 329.8}, {{53, 64, 41}, {106, 128, 82}, {213, 256, 165}, {425, 512, 330}}},
      {{416, 185.1, 512}, {{52, 23, 64}, {104, 46, 128}, {208, 93, 256}, {416, 185, 512}}},
      {{314.8, 214, 512}, {{39, 27, 64}, {79, 54, 128}, {157, 107, 256}, {315, 214, 512}}},
      {{512, 493.2, 228.8}, {{64, 62, 29}, {128, 123, 57}, {256, 247, 114}, {512, 493, 229}}}};
  for (const Row& row : rows)
    for (int i = 0; i < 4; ++i) {
      scene::Bounds bounds;
      bounds.extend({1.0, -2.0, 3.0});
      bounds.extend(glm::dvec3(1.0, -2.0, 3.0) + row.proportions);
      EXPECT_EQ(tightGrid(bounds, 64 << i, Sides::Nearest).resolution, row.sizes[i]) << i;
      const VoxelGrid covering = tightGrid(bounds, 64 << i);
      EXPECT_EQ(covering.origin, bounds.low);
      for (int axis = 0; axis < 3; ++axis) {
        // Covers the box with less than a voxel to spare.
        EXPECT_GE(covering.high()[axis], bounds.high[axis] - 1e-6);
        EXPECT_LT(covering.high()[axis], bounds.high[axis] + covering.voxelSize);
      }
    }
}

TEST(VoxelGrid, TakesBoxesWithoutExtent) {
  scene::Bounds bounds;
  EXPECT_EQ(tightGrid(bounds, 64).count(), 1);
  bounds.extend({5.0, 6.0, 7.0});
  const VoxelGrid point = tightGrid(bounds, 64);
  EXPECT_EQ(point.centre({0, 0, 0}), glm::dvec3(5.0, 6.0, 7.0));
  bounds.extend({7.0, 6.0, 8.0});
  EXPECT_EQ(tightGrid(bounds, 64).resolution, glm::ivec3(64, 1, 32));
}

// Triangles of all shapes: also slivers, segments and points.
TEST(ExactVoxels, SeparatingAxesAgreeWithClipping) {
  scene::Random random(7);
  int met = 0, undecided = 0;
  for (int i = 0; i < 40000; ++i) {
    glm::dvec3 corners[3];
    const double reach = random.uniform(0.1, 4.0);
    for (glm::dvec3& corner : corners)
      for (int axis = 0; axis < 3; ++axis) corner[axis] = 0.5 + random.uniform(-reach, reach);
    if (i % 4 == 1) corners[2] = 0.3 * corners[0] + 0.7 * corners[1];
    if (i % 4 == 2) corners[2] = corners[1] + 1e-4 * random.direction();
    if (i % 16 == 3) corners[1] = corners[2] = corners[0];
    const bool surely = clippedMeets(corners, glm::ivec3(0), -1e-9);
    const bool perhaps = clippedMeets(corners, glm::ivec3(0), 1e-9);
    if (surely != perhaps) {
      ++undecided;  // within rounding of the border
      continue;
    }
    ASSERT_EQ(meetsVoxel(corners, glm::ivec3(0)), surely) << "triangle " << i;
    met += surely;
  }
  EXPECT_GT(met, 4000);
  EXPECT_LT(met, 36000);
  EXPECT_LT(undecided, 5);
}

// Of a face between two voxels both are met; and corners count.
TEST(ExactVoxels, BordersBelongToVoxels) {
  const glm::dvec3 face[3] = {{0.2, 0.2, 1.0}, {0.8, 0.2, 1.0}, {0.2, 0.8, 1.0}};
  EXPECT_TRUE(meetsVoxel(face, {0, 0, 0}));
  EXPECT_TRUE(meetsVoxel(face, {0, 0, 1}));
  EXPECT_FALSE(meetsVoxel(face, {0, 0, 2}));
  EXPECT_FALSE(meetsVoxel(face, {1, 0, 0}));
  const glm::dvec3 point[3] = {glm::dvec3(1.0), glm::dvec3(1.0), glm::dvec3(1.0)};
  for (int i = 0; i < 8; ++i) EXPECT_TRUE(meetsVoxel(point, {i & 1, i >> 1 & 1, i >> 2}));
}

// What lies in voxels is the mesh: its area, and of a closed one no direction is left over.
TEST(ExactAttributes, AreasOfVoxelsAreTheMeshs) {
  scene::Scene scene;
  scene::addPart(scene, "ball", scene::sphere({0.1, -0.2, 0.3}, 0.7, 6), glm::vec3(0.25F));
  VoxelGrid grid = tightGrid(scene.bounds(), 13);
  grid.origin -= 0.013, grid.resolution += 1;
  double area = 0.0, expected = 0.0;
  glm::dvec3 left(0.0);
  for (const auto& [index, voxel] : exactAttributes(scene, scene.mesh, grid)) {
    area += voxel.area;
    left += voxel.area * voxel.normal;
    EXPECT_LE(glm::length(voxel.normal), 1.0 + 1e-12);
    EXPECT_NEAR(voxel.albedo.y, 0.25, 1e-12);
  }
  for (const glm::uvec3 t : scene.mesh.triangles)
    expected += 0.5 * glm::length(glm::cross(scene.mesh.positions[t.y] - scene.mesh.positions[t.x],
                                             scene.mesh.positions[t.z] - scene.mesh.positions[t.x]));
  EXPECT_NEAR(area * grid.voxelSize * grid.voxelSize, expected, 1e-9);
  EXPECT_LT(glm::length(left), 1e-9);
}

// A voxel of two surfaces, one of three times the area: their means by area.
TEST(ExactAttributes, SurfacesCountByArea) {
  scene::Scene scene;
  scene::addPart(scene, "wide", scene::card({0.5, 0.25, 0.5}, {0.0, 0.0, 0.3}, {0.3, 0.0, 0.0}),
                 {0.8F, 0.0F, 0.4F});
  scene::addPart(scene, "narrow", scene::card({0.5, 0.5, 0.75}, {0.1, 0.0, 0.0}, {0.0, 0.3, 0.0}),
                 {0.0F, 0.4F, 0.4F});
  VoxelGrid grid;
  const ExactAttributes voxel = exactAttributes(scene, scene.mesh, grid).at(0);
  EXPECT_NEAR(voxel.area, 0.36 + 0.12, 1e-9);
  EXPECT_NEAR(voxel.albedo.x, 0.6, 1e-6);
  EXPECT_NEAR(voxel.albedo.y, 0.1, 1e-6);
  EXPECT_NEAR(voxel.albedo.z, 0.4, 1e-6);
  EXPECT_NEAR(voxel.normal.y, 0.75, 1e-9);
  EXPECT_NEAR(voxel.normal.z, 0.25, 1e-9);
}

}  // namespace
}  // namespace limen::voxels

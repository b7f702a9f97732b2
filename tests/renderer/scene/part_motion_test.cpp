// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/part_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "renderer/scene/placement.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

glm::dvec3 moved(const PartMotion& motion, double timeS, glm::dvec3 point) {
  return glm::dvec3(motion.at(timeS) * glm::dvec4(point, 1.0));
}

void expectNear(glm::dvec3 found, glm::dvec3 expected) {
  // Doubles of size 10 through a rotation and two translations.
  EXPECT_LT(glm::length(found - expected), 1e-13) << found.x << ", " << found.y << ", " << found.z;
}

TEST(PartMotion, TurnsAboutThePivotAndTravelsToAndFro) {
  // A quarter turn about +y takes +z to +x.
  const PartMotion turning{.pivot = {1.0, 2.0, 3.0}, .turnDegS = 90.0};
  expectNear(moved(turning, 0.0, {1.0, 5.0, 4.0}), {1.0, 5.0, 4.0});
  expectNear(moved(turning, 1.0, {1.0, 5.0, 4.0}), {2.0, 5.0, 3.0});
  expectNear(moved(turning, 2.0, {1.0, 5.0, 4.0}), {1.0, 5.0, 2.0});
  expectNear(moved(turning, 4.0, {1.0, 5.0, 4.0}), {1.0, 5.0, 4.0});
  const PartMotion travelling{.travel = {0.0, 2.0, 0.0}, .periodS = 4.0, .startS = 1.0};
  expectNear(moved(travelling, -1.0, {1.0, 1.0, 1.0}), {1.0, 1.0, 1.0});
  expectNear(moved(travelling, 0.0, {1.0, 1.0, 1.0}), {1.0, 3.0, 1.0});
  expectNear(moved(travelling, 2.0, {1.0, 1.0, 1.0}), {1.0, -1.0, 1.0});
  // First the turn, then the way.
  const PartMotion both{.pivot = {1.0, 0.0, 0.0},
                        .axis = {0.0, 0.0, 1.0},
                        .turnDegS = 90.0,
                        .travel = {0.0, 0.0, 5.0},
                        .periodS = 4.0};
  expectNear(moved(both, 1.0, {3.0, 0.0, 0.0}), {1.0, 2.0, 5.0});
}

Scene twoBoxes() {
  Scene scene;
  addPart(scene, "still", box({-5.0, 0.0, -1.0}, {-4.0, 1.0, 0.0}), glm::vec3(0.5F));
  Mesh mesh = box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  mesh.normals.assign(mesh.positions.size(), {1.0F, 0.0F, 0.0F});
  addPart(scene, "moving", mesh, glm::vec3(0.5F));
  scene.motions = {
      {.part = 1, .pivot = {0.5, 0.0, 0.5}, .turnDegS = 90.0, .travel = {0.0, 3.0, 0.0}, .periodS = 4.0}};
  return scene;
}

TEST(PartMotion, MovesItsPartWithItsNormalsAndNothingElse) {
  const Scene scene = twoBoxes(), later = movedTo(scene, 1.0);
  EXPECT_TRUE(scene.traits().count("moving_parts"));
  EXPECT_FALSE(later.traits().count("moving_parts"));
  for (size_t i = 0; i < scene.mesh.positions.size(); ++i) {
    const glm::dvec3 p = scene.mesh.positions[i];
    if (p.x < -1.0) {
      EXPECT_EQ(later.mesh.positions[i], p);
      continue;
    }
    // (x, z) about (0.5, 0.5): x' = 0.5 + (z - 0.5), z' = 0.5 - (x - 0.5).
    expectNear(later.mesh.positions[i], {p.z, p.y + 3.0, 1.0 - p.x});
    EXPECT_LT(glm::length(later.mesh.normals[i] - glm::vec3(0.0F, 0.0F, -1.0F)), 1e-6F);
  }
  EXPECT_NE(scene.contentHash(), later.contentHash());
  Scene faster = scene;
  faster.motions[0].turnDegS = 91.0;
  EXPECT_NE(scene.contentHash(), faster.contentHash());
}

TEST(PartMotion, BoundsHoldAllThatAPathReaches) {
  const Scene scene = twoBoxes();
  const Bounds bounds = scene.bounds();
  for (int step = 0; step <= 100; ++step)
    for (const glm::dvec3& position : movedTo(scene, 0.043 * step).mesh.positions)
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_GE(position[axis], bounds.low[axis] - 1e-12);
        EXPECT_LE(position[axis], bounds.high[axis] + 1e-12);
      }
  // No more than the circle through the farthest corner, which is sqrt(1.5) from the pivot, and the way.
  EXPECT_NEAR(bounds.high.y, std::sqrt(1.5) + 3.0, 1e-12);
}

TEST(PartMotion, GoesWithThePlacedWorld) {
  Scene scene = twoBoxes();
  setStillCamera(scene, {{0.0, 0.0, 9.0}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 40.0});
  Scene placed = scene;
  PlacementSettings settings;
  settings.scale = 2.0;
  settings.offset = 3.0;
  place(placed, settings, "here");
  const glm::dvec3 shift(3.0 * 2.0 * scene.bounds().diagonal() / std::sqrt(3.0));
  const Scene expected = movedTo(scene, 0.7), found = movedTo(placed, 0.7);
  for (size_t i = 0; i < expected.mesh.positions.size(); ++i)
    EXPECT_LT(glm::length(found.mesh.positions[i] - (2.0 * expected.mesh.positions[i] + shift)), 1e-11);
}

TEST(PartMotion, RefusesSharedVerticesAndSolidTextures) {
  Scene scene = twoBoxes();
  EXPECT_NO_THROW(motionsOfVertices(scene));
  scene.mesh.triangles[0].x = scene.mesh.triangles[scene.parts[1].firstTriangle].x;
  EXPECT_THROW(motionsOfVertices(scene), std::logic_error);
  scene = twoBoxes();
  scene.materials[1].pattern.kind = Pattern::Kind::Checker;
  EXPECT_THROW(motionsOfVertices(scene), std::logic_error);
}

}  // namespace
}  // namespace limen::scene

// SPDX-License-Identifier: BSD-3-Clause
// Which parts of a scene are rigid objects, and the spheres around them.
#include "renderer/visibility_fields/rigid_objects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/scene/shapes.h"
#include "renderer/visibility_fields/bounding_sphere.h"
#include "renderer/visibility_fields/field_bindings.h"

namespace limen::visibility_fields {
namespace {

TEST(Sphere, HoldsAllPointsAndIsSmall) {
  // Of a box: half its diagonal. Of a regular tetrahedron: its corners' distance from the middle.
  const Sphere ofBox = boundingSphere(scene::box({-1, -2, -3}, {1, 2, 3}).positions);
  EXPECT_NEAR(ofBox.radius, std::sqrt(14.0), 0.01 * std::sqrt(14.0));
  const std::vector<glm::dvec3> corners = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  const Sphere ofCorners = boundingSphere(corners);
  EXPECT_NEAR(ofCorners.radius, std::sqrt(3.0), 0.02 * std::sqrt(3.0));
  for (const glm::dvec3 p : corners)
    EXPECT_LE(glm::distance(p, ofCorners.centre), ofCorners.radius * (1.0 + 1e-12));
}

TEST(Objects, ArePartsOrConnectedPieces) {
  scene::Scene scene;
  scene::Part ground{.name = "ground", .firstTriangle = 0, .triangleCount = 2, .receiverOnly = true};
  scene::append(scene.mesh, scene::card({0, 0, 0}, {0, 0, 9}, {9, 0, 0}));
  scene::Mesh two = scene::box({0, 0, 0}, {1, 1, 1});
  scene::append(two, scene::box({3, 0, 0}, {4, 1, 1}));
  scene::Part part{
      .name = "boxes", .firstTriangle = 2, .triangleCount = static_cast<uint32_t>(two.triangles.size())};
  scene::append(scene.mesh, two);
  scene.materials.emplace_back();
  scene.parts = {ground, part};
  const RigidObjects parts = rigidObjectsOf(scene, PartObjects{});
  ASSERT_EQ(parts.objects.size(), 1U);
  EXPECT_EQ(parts.objectOf[0], 0xffffffffU);
  EXPECT_EQ(parts.objectOf[2], 0U);
  const RigidObjects pieces = rigidObjectsOf(scene, PieceObjects{});
  ASSERT_EQ(pieces.objects.size(), 2U);
  for (size_t i = 2; i < pieces.objectOf.size(); ++i) EXPECT_EQ(pieces.objectOf[i], i < 14 ? 0U : 1U);
  // As pieces up to the limit, as a part beyond it.
  EXPECT_EQ(rigidObjectsOf(scene, AutoObjects{2}).objectOf, pieces.objectOf);
  EXPECT_EQ(rigidObjectsOf(scene, AutoObjects{1}).objectOf, parts.objectOf);
}

// Parts of many pieces each, all within their own limit: those that would leave no room for the parts to come
// are one object.
TEST(Objects, AutoKeepsRoomForEveryPart) {
  scene::Scene scene;
  scene.materials.emplace_back();
  for (int part = 0; part < 20; ++part) {
    scene::Mesh mesh;
    for (int piece = 0; piece < 30; ++piece)
      scene::append(
          mesh, scene::box(glm::dvec3(3 * piece, 3 * part, 0), glm::dvec3(3 * piece + 1, 3 * part + 1, 1)));
    scene.parts.push_back({.name = "boxes",
                           .firstTriangle = static_cast<uint32_t>(scene.mesh.triangles.size()),
                           .triangleCount = static_cast<uint32_t>(mesh.triangles.size())});
    scene::append(scene.mesh, mesh);
  }
  const RigidObjects objects = rigidObjectsOf(scene, AutoObjects{});
  // 8 parts of 30 pieces, and 12 whole: a ninth in pieces would make 270 of 256.
  EXPECT_EQ(objects.objects.size(), 8U * 30U + 12U);
  EXPECT_EQ(std::count(objects.objectOf.begin(), objects.objectOf.end(), kFieldNoObject), 0);
}

}  // namespace
}  // namespace limen::visibility_fields

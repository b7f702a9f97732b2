// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "renderer/scene/light.h"

namespace limen::scene {
namespace {

/// Two triangles, the second only receives.
Scene twoTriangles() {
  Scene scene;
  scene.mesh.positions = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, {9.0, 9.0, 9.0}};
  scene.mesh.triangles = {{0, 1, 2}, {1, 2, 3}};
  scene.parts = {{"a", 0, 1, 0, false}, {"b", 1, 1, 1, true}};
  scene.materials = {{"grey", glm::vec3(0.5F)}, {"white", glm::vec3(1.0F)}};
  scene.lights = {AreaLight{}};
  scene.camera.keys = {{0.0, Camera{}}};
  return scene;
}

TEST(Scene, BoundsTakeAllAndCasterBoundsOnlyWhatShadows) {
  Scene scene = twoTriangles();
  EXPECT_EQ(scene.bounds().high, glm::dvec3(9.0));
  EXPECT_EQ(scene.casterBounds().low, glm::dvec3(0.0));
  EXPECT_EQ(scene.casterBounds().high, glm::dvec3(1.0, 2.0, 0.0));
  EXPECT_NEAR(scene.casterBounds().diagonal(), std::sqrt(5.0), 1e-15);
  scene.mesh.positions[3].x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(scene.bounds().high, glm::dvec3(1.0, 2.0, 0.0));
  EXPECT_TRUE(Scene{}.bounds().empty());
  EXPECT_EQ(Scene{}.bounds().diagonal(), 0.0);
}

TEST(Scene, HashSeesEverythingThatDecidesAPicture) {
  const std::string before = twoTriangles().contentHash();
  EXPECT_EQ(before.size(), 64U);
  EXPECT_EQ(twoTriangles().contentHash(), before);
  const std::vector<std::function<void(Scene&)>> changes = {
      [](Scene& s) { s.mesh.positions[3].z = std::nextafter(9.0, 10.0); },
      [](Scene& s) { s.mesh.positions.push_back({}); },
      [](Scene& s) { std::swap(s.mesh.triangles[0].x, s.mesh.triangles[0].y); },
      [](Scene& s) { s.mesh.triangles.pop_back(); },
      [](Scene& s) { s.parts[0].firstTriangle = 1; },
      [](Scene& s) { s.parts[0].triangleCount = 2; },
      [](Scene& s) { s.parts[0].material = 1; },
      [](Scene& s) { s.parts[1].receiverOnly = false; },
      [](Scene& s) { s.materials[1].albedo.b = 0.9F; },
      [](Scene& s) { s.lights.push_back({}); },
      [](Scene& s) { s.lights[0].shape = LightShape::Disc; },
      [](Scene& s) { s.lights[0].centre.y += 1.0; },
      [](Scene& s) { s.lights[0].axisX.x = -1.0; },
      [](Scene& s) { s.lights[0].axisY.y = -1.0; },
      [](Scene& s) { s.lights[0].size.y = 2.0; },
      [](Scene& s) { s.lights[0] = withShape(s.lights[0], LightShape::Polygon); },
      [](Scene& s) { s.lights[0].parts.push_back({}); },
      [](Scene& s) { s.lights[0].parts[0].radiance.r = 2.0F; },
      [](Scene& s) {
        s.lights[0].parts[0].outline = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}};
      },
      [](Scene& s) { s.camera.keys[0].timeS = 1.0; },
      [](Scene& s) { s.camera.keys[0].camera.eye.x = 1.0; },
      [](Scene& s) { s.camera.keys[0].camera.target.x = 1.0; },
      [](Scene& s) { s.camera.keys[0].camera.up.x = 1.0; },
      [](Scene& s) { s.camera.keys[0].camera.verticalFovDeg = 46.0; },
      [](Scene& s) { s.camera.keys.push_back(s.camera.keys[0]); }};
  std::set<std::string> hashes = {before};
  for (size_t i = 0; i < changes.size(); ++i) {
    Scene scene = twoTriangles();
    changes[i](scene);
    EXPECT_TRUE(hashes.insert(scene.contentHash()).second) << "change " << i << " went unseen";
  }
}

TEST(Scene, HashLeavesNamesOut) {
  Scene scene = twoTriangles();
  scene.name = "other", scene.parts[0].name = "other", scene.materials[0].name = "other";
  EXPECT_EQ(scene.contentHash(), twoTriangles().contentHash());
}

TEST(Scene, TraitsNameTheFirstLightsKind) {
  using testing::Contains;
  using testing::Not;
  Scene scene = twoTriangles();
  EXPECT_THAT(scene.traits(), testing::UnorderedElementsAre("area_light", "rectangular_light", "casters",
                                                            "receiver_only_parts"));
  scene.lights[0].shape = LightShape::Disc;
  EXPECT_THAT(scene.traits(), Contains("disc_light"));
  EXPECT_THAT(scene.traits(), Not(Contains("rectangular_light")));
  scene.lights[0] = withShape(scene.lights[0], LightShape::Polygon);
  EXPECT_THAT(scene.traits(), Contains("polygonal_light"));
  scene = twoTriangles();
  scene.lights[0].parts.push_back({});
  EXPECT_THAT(scene.traits(), Contains("multi_part_light"));
  EXPECT_THAT(scene.traits(), Not(Contains("rectangular_light")));
  scene.lights.push_back({});
  scene.camera.keys.push_back({1.0, Camera{}});
  EXPECT_THAT(scene.traits(), Contains("several_lights"));
  EXPECT_THAT(scene.traits(), Contains("moving_camera"));
  EXPECT_TRUE(Scene{}.traits().empty());
}

}  // namespace
}  // namespace limen::scene

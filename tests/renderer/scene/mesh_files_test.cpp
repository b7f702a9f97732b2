// SPDX-License-Identifier: BSD-3-Clause
// Real meshes: public-domain ones of meshes/, and those of the package glmark2-data.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "renderer/scene/import.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

/// Triangles of an OBJ file by its 'f' lines alone: a polygon of n corners makes n - 2.
size_t countTriangles(const std::string& path) {
  std::ifstream file(path);
  size_t count = 0;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word != "f") continue;
    size_t corners = 0;
    while (words >> word) ++corners;
    count += corners - 2;
  }
  return count;
}

class ObjFile : public testing::TestWithParam<std::string> {};

TEST_P(ObjFile, HasAsManyTrianglesAsItsFacesSay) {
  const std::string path = std::string(LIMEN_SOURCE_DIR) + "/tests/renderer/scene/meshes/" + GetParam();
  ASSERT_GT(countTriangles(path), 0U) << path;
  EXPECT_EQ(importMesh(path).mesh.triangles.size(), countTriangles(path));
}

INSTANTIATE_TEST_SUITE_P(Meshes, ObjFile, testing::Values("spot_cage.obj", "cornell_box.obj"));

class Model : public testing::TestWithParam<std::string> {};

TEST_P(Model, IsOneMetreHighAndStandsInTheMiddleOfItsPlane) {
  if (!fixtures::installed(GetParam())) GTEST_SKIP() << "the package glmark2-data is not installed";
  const Scene scene = fixtures::build(GetParam());
  const Bounds casters = scene.casterBounds();
  EXPECT_EQ(casters.low.y, 0.0);
  EXPECT_NEAR(casters.high.y, 1.0, 1e-12);
  EXPECT_NEAR(casters.centre().x, 0.0, 1e-12);
  EXPECT_NEAR(casters.centre().z, 0.0, 1e-12);
  EXPECT_TRUE(scene.parts[0].receiverOnly);
  EXPECT_GE(scene.bounds().high.x - scene.bounds().low.x, 8.0);
  EXPECT_GT(scene.mesh.triangles.size(), 5000U);
}

INSTANTIATE_TEST_SUITE_P(Glmark2, Model, testing::Values("bunny", "horse", "cat"), fixtures::nameOf);

TEST(BunnyModel, HasAsManyTrianglesAsItsFacesSay) {
  const std::string path = "/usr/share/glmark2/models/bunny.obj";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "the package glmark2-data is not installed";
  EXPECT_EQ(importMesh(path).mesh.triangles.size(), countTriangles(path));
}

}  // namespace
}  // namespace limen::scene

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/import.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tests/renderer/scene/geometry_checks.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

using fixtures::TemporaryFolder;
using testing::HasSubstr;

class Import : public testing::Test {
 protected:
  ImportedMesh read(const std::string& name, const std::string& content) const {
    return importMesh(folder_.write(name, content));
  }
  /// Message of the error; it must name the file.
  std::string refusal(const std::string& name, const std::string& content) const {
    try {
      read(name, content);
    } catch (const Error& error) {
      EXPECT_THAT(error.where(), HasSubstr(name));
      EXPECT_FALSE(error.hint().empty());
      return error.message();
    }
    return {};
  }
  TemporaryFolder folder_;
};

TEST_F(Import, ObjQuadBecomesTwoTrianglesThatShareVertices) {
  const ImportedMesh in = read("quad.obj", "v 0 0 0\nv 2 0 0\nv 2 0 -3\nv 0 0 -3\nf 1 2 3 4\n");
  EXPECT_EQ(in.mesh.positions.size(), 4U);
  EXPECT_EQ(in.mesh.triangles.size(), 2U);
  EXPECT_NEAR(checks::surfaceArea(in.mesh), 6.0, 1e-12);
  const auto hit = checks::intersect(in.mesh, {1.0, 5.0, -1.0}, {0.0, -1.0, 0.0});
  ASSERT_TRUE(hit);
  EXPECT_GT(hit->normal.y, 0.0);
  ASSERT_EQ(in.parts.size(), 1U);
  EXPECT_EQ(in.parts[0].triangleCount, 2U);
}

TEST_F(Import, ObjNegativeIndicesCountFromTheEnd) {
  const ImportedMesh in = read("negative.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\n");
  ASSERT_EQ(in.mesh.triangles.size(), 1U);
  EXPECT_EQ(in.mesh.positions.size(), 3U);
  EXPECT_EQ(checks::corner(in.mesh, 0, 0), glm::dvec3(0.0));
  EXPECT_EQ(checks::corner(in.mesh, 0, 1), glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_EQ(checks::corner(in.mesh, 0, 2), glm::dvec3(0.0, 1.0, 0.0));
}

TEST_F(Import, ObjConcavePolygonKeepsItsArea) {
  // An L of area 3, listed from its inner corner on.
  const ImportedMesh in =
      read("l.obj", "v 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 0\nv 2 0 0\nv 2 1 0\nf 1 2 3 4 5 6\n");
  EXPECT_EQ(in.mesh.triangles.size(), 4U);
  EXPECT_NEAR(checks::surfaceArea(in.mesh), 3.0, 1e-12);
}

TEST_F(Import, JoinsVerticesAtExactlyTheSamePlaceAndNoOthers) {
  // Two triangles with an edge in common, written as a soup with texture coordinates and normals that differ;
  // a third one a millionth beside it.
  const ImportedMesh in =
      read("soup.obj",
           "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nv -0 1 0\nv 0.000001 0 0\nv 1 0 1\nv 0 1 1\n"
           "vt 0 0\nvt 1 0\nvn 0 0 1\nvn 0 1 0\n"
           "f 1/1/1 2/1/1 3/1/1\nf 4/2/2 5/2/2 6/2/2\nf 7/1/1 8/1/1 9/1/1\n");
  EXPECT_EQ(in.mesh.triangles.size(), 3U);
  EXPECT_EQ(in.mesh.positions.size(), 4U + 3U);
}

TEST_F(Import, KeepsDegenerateTrianglesAndDropsPointsAndLines) {
  const ImportedMesh in = read(
      "mixed.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nv 0.5 0 0\nf 1 2 3\nf 1 2 5\nf 1 1 2\nl 1 4\np 4\n");
  EXPECT_EQ(in.mesh.triangles.size(), 3U);
  EXPECT_EQ(in.mesh.positions.size(), 4U);
}

TEST_F(Import, MaterialsBecomeAlbedosAndParts) {
  folder_.write("two.mtl", "newmtl red\nKd 0.8 0.1 0.05\nnewmtl bright\nKd 3 0.5 0.25\n");
  const ImportedMesh in =
      read("two.obj",
           "mtllib two.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nusemtl red\nf 1 2 3\nusemtl "
           "bright\nf 2 4 3\n");
  ASSERT_EQ(in.parts.size(), 2U);
  EXPECT_EQ(in.parts[1].firstTriangle, 1U);
  const Material& red = in.materials[in.parts[0].material];
  EXPECT_EQ(red.name, "red");
  EXPECT_NEAR(glm::length(red.albedo - glm::vec3(0.8F, 0.1F, 0.05F)), 0.0F, 1e-6F);
  EXPECT_NEAR(glm::length(in.materials[in.parts[1].material].albedo - glm::vec3(1.0F, 0.5F, 0.25F)), 0.0F,
              1e-6F);
  EXPECT_EQ(in.mesh.positions.size(), 4U);
}

TEST_F(Import, PlyPolygons) {
  const std::string header =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const ImportedMesh in = read("quad.ply", header + "4 0 1 2 3\n");
  EXPECT_EQ(in.mesh.triangles.size(), 2U);
  EXPECT_NEAR(checks::surfaceArea(in.mesh), 1.0, 1e-12);
  EXPECT_NE(refusal("range.ply", header + "4 0 1 2 7\n"), "");
}

/// One triangle under two nodes: the outer one moves, the inner one mirrors and stretches.
TEST_F(Import, GltfNodeTransformsAreAppliedAndMirrorsKeepTheOutsideOut) {
  const float positions[9] = {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, 1.0F, 0.0F};
  const uint16_t indices[4] = {0, 1, 2, 0};
  std::string buffer(sizeof positions + sizeof indices, '\0');
  std::memcpy(buffer.data(), positions, sizeof positions);
  std::memcpy(buffer.data() + sizeof positions, indices, sizeof indices);
  folder_.write("t.bin", buffer);
  const ImportedMesh in =
      read("t.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"translation": [10, 0, 0], "children": [1, 2]}, {"mesh": 0, "scale": [-2, 3, 1]}, {"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "materials": [{"name": "m", "pbrMetallicRoughness": {"baseColorFactor": [0.25, 0.5, 0.75, 1]}}],
    "buffers": [{"uri": "t.bin", "byteLength": 44}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                   "min": [0,0,0], "max": [1,1,0]},
                  {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}]})");
  ASSERT_EQ(in.mesh.triangles.size(), 2U);
  ASSERT_EQ(in.parts.size(), 2U);
  Bounds bounds;
  for (const glm::dvec3& p : in.mesh.positions) bounds.extend(p);
  EXPECT_EQ(bounds.low, glm::dvec3(8.0, 0.0, 0.0));
  EXPECT_EQ(bounds.high, glm::dvec3(11.0, 3.0, 0.0));
  // The mirror image of a triangle that faces +z across x still faces +z.
  for (size_t t = 0; t < 2; ++t)
    EXPECT_GT(glm::cross(checks::corner(in.mesh, t, 1) - checks::corner(in.mesh, t, 0),
                         checks::corner(in.mesh, t, 2) - checks::corner(in.mesh, t, 0))
                  .z,
              0.0);
  EXPECT_EQ(in.mesh.positions.size(), 5U);  // the corner at (10, 0, 0) is common to both
  EXPECT_EQ(in.materials[in.parts[0].material].albedo, glm::vec3(0.25F, 0.5F, 0.75F));
}

TEST_F(Import, RefusesWhatIsBroken) {
  EXPECT_NE(refusal("range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"), "");
  EXPECT_NE(refusal("negative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -4\n"), "");
  EXPECT_THAT(refusal("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("not finite"));
  EXPECT_THAT(refusal("huge.obj", "v 0 0 0\nv 1e300 0 0\nv 0 1 0\nf 1 2 3\n"), HasSubstr("not finite"));
  EXPECT_NE(refusal("empty.obj", ""), "");
  EXPECT_NE(refusal("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), "");
  EXPECT_NE(refusal("lines.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"), "");
  EXPECT_NE(refusal("text.ply", "this is no mesh"), "");
  EXPECT_NE(refusal("cut.gltf", "{\"asset\": {\"version\": \"2.0\"}, \"scenes\": ["), "");
  EXPECT_NE(refusal("unknown.xyz", "0 0 0"), "");
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  EXPECT_NE(refusal("few_vertices.ply", ply + "0 0 0\n1 0 0\n"), "");
  EXPECT_NE(refusal("few_faces.ply", ply + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n"), "");
  EXPECT_NE(refusal("no_buffer.gltf", R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
    "buffers": [{"uri": "absent.bin", "byteLength": 36}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]})"),
            "");
}

TEST_F(Import, RefusesWhatIsNoFile) {
  EXPECT_THROW(importMesh(folder_.path() + "/absent.obj"), Error);
  EXPECT_THROW(importMesh(folder_.path()), Error);
  EXPECT_THROW(importMesh(""), Error);
}

TEST_F(Import, SaysNothingOnTheConsole) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  read("fine.obj", "mtllib absent.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  refusal("range.obj", "v 0 0 0\nf 1 2 4\n");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(MeshScene, StandsOnTheGroundWithTheFilesUnitsAndUpAxis) {
  const Scene scene = fixtures::build("mesh");
  EXPECT_EQ(scene.casterBounds().low.y, 0.0);
  EXPECT_NEAR(scene.casterBounds().high.y, 1.0, 1e-12);
  EXPECT_TRUE(scene.parts[0].receiverOnly);
  EXPECT_GT(checks::signedVolume(scene.mesh, scene.parts[1].firstTriangle, scene.parts[1].triangleCount),
            0.0);

  // Up is then the file's z, which goes from -0.5 to 0.
  const Scene turned = fixtures::build("mesh", {{"up", std::string("z")}});
  EXPECT_NEAR(turned.casterBounds().high.y, 0.5, 1e-12);
  EXPECT_GT(checks::signedVolume(turned.mesh, turned.parts[1].firstTriangle, turned.parts[1].triangleCount),
            0.0);
  EXPECT_NE(turned.contentHash(), scene.contentHash());

  EXPECT_EQ(fixtures::build("mesh", {{"ground", false}}).parts.size(), 1U);
}

TEST(TurnZUpToYUp, TakesZToYAndKeepsHandedness) {
  Mesh mesh;
  mesh.positions = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
  turnZUpToYUp(mesh);
  EXPECT_EQ(mesh.positions[2], glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(glm::dot(glm::cross(mesh.positions[0], mesh.positions[1]), mesh.positions[2]), 1.0);
}

}  // namespace
}  // namespace limen::scene

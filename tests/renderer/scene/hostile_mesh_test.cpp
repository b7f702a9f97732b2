// SPDX-License-Identifier: BSD-3-Clause
// Mesh files that crash importers, take all memory or all time: each is an Error that names the file, and the
// program goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstring>
#include <random>

#include "experiments/base/file_references.h"
#include "experiments/base/hash.h"
#include "renderer/scene/import.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::scene {
namespace {

using fixtures::TemporaryFolder;
using testing::AllOf;
using testing::HasSubstr;

const std::string kTriangleObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

std::string gltf(const std::string& nodes, const std::string& buffer, const std::string& accessor = "3") {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": )" + nodes +
         R"(, "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "buffers": [)" + buffer +
         R"(], "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": )" +
         accessor + R"(, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]}]})";
}

std::string triangleBuffer(float last = 1.0F) {
  const float positions[9] = {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 0.0F, last, 0.0F};
  std::string bytes(sizeof positions, '\0');
  std::memcpy(bytes.data(), positions, sizeof positions);
  return bytes;
}

class HostileMesh : public testing::Test {
 protected:
  /// The error's message; it names the file. That it comes at all is what the test's own time limit is for.
  std::string refusal(const std::string& path, const ImportLimits& limits = {}) const {
    try {
      importMesh(path, limits);
    } catch (const Error& error) {
      EXPECT_EQ(error.where(), path);
      EXPECT_FALSE(error.hint().empty());
      return error.what();
    }
    ADD_FAILURE() << path << " was imported";
    return {};
  }
  std::string refusalOf(const std::string& name, const std::string& text,
                        const ImportLimits& limits = {}) const {
    return refusal(folder_.write(name, text), limits);
  }
  std::string fifo(const std::string& name) const {
    const std::string path = folder_.path() + "/" + name;
    EXPECT_EQ(mkfifo(path.c_str(), 0600), 0);
    return path;
  }
  TemporaryFolder folder_;
};

TEST_F(HostileMesh, OtherFormatsAreRefusedWithTheListOfThoseThatAreRead) {
  for (const char* name : {"a.fbx", "a.x", "a.blend", "a.txt", "a"})
    EXPECT_THAT(refusalOf(name, kTriangleObj),
                AllOf(HasSubstr("OBJ"), HasSubstr("PLY"), HasSubstr("glTF"), HasSubstr("OFF"),
                      HasSubstr("STL"), HasSubstr("3DS"), HasSubstr("COLLADA")));
  // Nor is one taken by its content: this is a file of DirectX.
  refusalOf("x.obj", "xof 0302txt 0064\nMesh m { 3; 0;0;0;, 1;0;0;, 0;1;0;; 1; 3;0,1,2;; }\n");
}

TEST_F(HostileMesh, EndingsInCapitalsAreKnown) {
  EXPECT_EQ(importMesh(folder_.write("A.OBJ", kTriangleObj)).mesh.triangles.size(), 1U);
}

TEST_F(HostileMesh, WhatIsNoFileIsRefusedWithoutWaiting) {
  refusal(fifo("pipe.obj"));
  std::filesystem::create_directory(folder_.path() + "/folder.ply");
  refusal(folder_.path() + "/folder.ply");
  std::filesystem::create_symlink("/dev/zero", folder_.path() + "/zero.stl");
  refusal(folder_.path() + "/zero.stl");
}

TEST_F(HostileMesh, WhatItRefersToIsNoPipeAndNoDevice) {
  fifo("m.mtl");
  EXPECT_EQ(importMesh(folder_.write("pipe.obj", "mtllib m.mtl\n" + kTriangleObj)).mesh.triangles.size(), 1U);
  fifo("b.bin");
  refusalOf("pipe.gltf", gltf(R"([{"mesh": 0}])", R"({"uri": "b.bin", "byteLength": 36})"));
  refusalOf("zero.gltf", gltf(R"([{"mesh": 0}])", R"({"uri": "/dev/zero", "byteLength": 36})"));
}

TEST_F(HostileMesh, FewBytesDoNotTakeAllMemory) {
  const std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2000000000\nproperty double x\nproperty double "
      "y\n"
      "property double z\nelement face 2000000000\nproperty list uchar int vertex_indices\nend_header\n";
  refusalOf("large.ply", ply + std::string(200, '\0'));
  // 2^40 instances of a triangle.
  std::string nodes = "[";
  for (int i = 0; i < 40; ++i)
    nodes += "{\"children\": [" + std::to_string(2 * i + 2) + "," + std::to_string(2 * i + 3) + "]}," +
             "{\"children\": [" + std::to_string(2 * i + 2) + "," + std::to_string(2 * i + 3) + "]},";
  folder_.write("b.bin", triangleBuffer());
  refusalOf("tree.gltf",
            gltf(nodes + R"({"mesh": 0}, {"mesh": 0}])", R"({"uri": "b.bin", "byteLength": 36})"),
            {.memoryMiB = 512.0, .seconds = 5.0});
}

TEST_F(HostileMesh, DeepNestingEndsTheImportAlone) {
  std::string dae =
      "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
      "version=\"1.4.1\"><asset/><library_visual_scenes><visual_scene id=\"s\">";
  constexpr int kDeep = 300000;
  for (int i = 0; i < kDeep; ++i) dae += "<node>";
  for (int i = 0; i < kDeep; ++i) dae += "</node>";
  refusalOf("deep.dae", dae +
                            "</visual_scene></library_visual_scenes><scene><instance_visual_scene "
                            "url=\"#s\"/></scene></COLLADA>");
}

TEST_F(HostileMesh, AnImportEndsAtItsTime) {
  EXPECT_THAT(refusalOf("fine.obj", kTriangleObj, {.seconds = 1.0, .patience = 1e-7}),
              HasSubstr("takes longer than"));
}

TEST_F(HostileMesh, AnImportEndsAtItsMemory) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the shadow memory of AddressSanitizer is beyond any limit, so none is set";
#endif
  std::string obj;
  for (int i = 0; i < 200000; ++i) obj += "v " + std::to_string(i) + " 0 0\n";
  for (int i = 1; i + 2 <= 200000; ++i)
    obj += "f " + std::to_string(i) + ' ' + std::to_string(i + 1) + ' ' + std::to_string(i + 2) + '\n';
  const std::string path = folder_.write("line.obj", obj);
  EXPECT_THAT(refusal(path, {.memoryMiB = 32.0, .memoryPerByte = 0.0}), HasSubstr("memory"));
  EXPECT_EQ(importMesh(path).mesh.triangles.size(), 199998U);
}

TEST_F(HostileMesh, PolygonsWithoutAnAreaAreLeftOut) {
  const ImportedMesh in =
      importMesh(folder_.write("p.obj",
                               "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 0\n"
                               "f 1 1 1 1\nf 1 2 1 2\nf 1 2 2 1 1\nf 1 5 1 5 1\nf 1 1 2 2 3 3\nf 1 2 3 4\n"));
  // What is left: a triangle, written with each corner twice, and the square.
  EXPECT_EQ(in.mesh.triangles.size(), 3U);
}

TEST_F(HostileMesh, ChangedBytesAreReadOrRefused) {
  folder_.write("b.bin", triangleBuffer());
  const std::vector<std::pair<std::string, std::string>> seeds = {
      {"f.obj",
       "mtllib f.mtl\no a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nusemtl m\n"
       "f 1/1/1 2/1/1 3/1/1 4/1/1\nf -1 -2 -3\nl 1 2\n"},
      {"f.ply",
       "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n"
       "4 0 1 2 3\n"},
      {"f.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"},
      {"f.stl",
       "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
       "endfacet\nendsolid a\n"},
      {"f.gltf", gltf(R"([{"children": [1]}, {"mesh": 0}])", R"({"uri": "b.bin", "byteLength": 36})")}};
  std::mt19937 random(20261122);
  for (const auto& [name, seed] : seeds)
    for (int round = 0; round < 12; ++round) {
      std::string text = seed;
      for (int change = 0; change < 3; ++change) {
        const size_t at = random() % text.size();
        const char* const pieces[] = {"-1", "99999999999", "nan", "1e308", "\xff", "{", "0", "\n", "\""};
        text.replace(at, 1 + random() % 2, pieces[random() % std::size(pieces)]);
      }
      try {
        importMesh(folder_.write(name, text), {.memoryMiB = 512.0, .seconds = 5.0});
      } catch (const Error& error) {
        EXPECT_THAT(error.where(), HasSubstr(name)) << text;
      }
    }
}

TEST_F(HostileMesh, AHashCoversWhatIsImported) {
  const std::string obj = folder_.write("h.obj", "mtllib h.mtl\n" + kTriangleObj);
  const std::string alone = sha256WithReferences(obj);
  folder_.write("h.mtl", "newmtl m\nKd 1 0 0\n");
  const std::string red = sha256WithReferences(obj);
  folder_.write("h.mtl", "newmtl m\nKd 0 1 0\n");
  EXPECT_NE(alone, red);
  EXPECT_NE(sha256WithReferences(obj), red);

  const std::string file =
      folder_.write("h.gltf", gltf(R"([{"mesh": 0}])", R"({"uri": "a%20b.bin", "byteLength": 36})"));
  folder_.write("a b.bin", triangleBuffer(1.0F));
  const std::string one = sha256WithReferences(file);
  folder_.write("a b.bin", triangleBuffer(2.0F));
  EXPECT_NE(sha256WithReferences(file), one);

  // A moved folder is the same; a file without references has the hash that it always had.
  const TemporaryFolder other;
  other.write("h.mtl", "newmtl m\nKd 0 1 0\n");
  EXPECT_EQ(sha256WithReferences(other.write("h.obj", "mtllib h.mtl\n" + kTriangleObj)),
            sha256WithReferences(obj));
  const std::string plain = folder_.write("plain.obj", kTriangleObj);
  EXPECT_EQ(sha256WithReferences(plain), sha256File(plain));
}

/// Names that the hash does not know of must decide nothing.
TEST_F(HostileMesh, OnlyFilesThatTheHashCoversAreOpened) {
  folder_.write("k.mtl", "newmtl m\nKd 0.5 0.25 0\n");
  const std::vector<std::string> ways = {"mtllib k.mtl\n", "  mtllib   k.mtl  \n", "mtllib \\\nk.mtl\n",
                                         "mtllib absent.mtl\n"};
  for (size_t i = 0; i < ways.size(); ++i) {
    const std::string path = folder_.write("k.obj", ways[i] + "usemtl m\n" + kTriangleObj);
    const ImportedMesh before = importMesh(path);
    const std::string hash = sha256WithReferences(path);
    folder_.write("k.mtl", "newmtl m\nKd 0 0.75 " + std::to_string(0.1 * static_cast<double>(i)) + "\n");
    const ImportedMesh after = importMesh(path);
    const auto colour = [](const ImportedMesh& mesh) {
      return mesh.materials[mesh.parts[0].material].albedo;
    };
    EXPECT_TRUE(colour(before) == colour(after) || sha256WithReferences(path) != hash) << ways[i];
  }
}

}  // namespace
}  // namespace limen::scene

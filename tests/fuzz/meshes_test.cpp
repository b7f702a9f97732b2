// SPDX-License-Identifier: BSD-3-Clause
// Meshes in every format that is imported.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>

#include "experiments/base/error.h"
#include "renderer/scene/import.h"
#include "tests/fuzz/rounds.h"

namespace limen::fuzz {
namespace {

template <class T>
std::string raw(std::initializer_list<T> values) {
  std::string out;
  for (const T value : values) out.append(reinterpret_cast<const char*>(&value), sizeof value);
  return out;
}

const std::string kSquare = raw<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0});

std::string gltf(const std::string& buffer) {
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
  "nodes": [{"children": [1], "translation": [1, 2, 3]}, {"mesh": 0, "rotation": [0, 0, 0, 1]}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
  "materials": [{"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}],
  "buffers": [)" +
         buffer + R"(],
  "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
  "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0,0,0], "max": [1,1,0]},
    {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}]})";
}

std::string glb() {
  std::string json = gltf(R"({"byteLength": 60})");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string data = kSquare + raw<uint16_t>({0, 1, 2, 0, 2, 3});
  const auto size = [](const std::string& text) { return static_cast<uint32_t>(text.size()); };
  return "glTF" + raw<uint32_t>({2, 12 + 8 + size(json) + 8 + size(data), size(json)}) + "JSON" + json +
         raw<uint32_t>({size(data)}) + std::string("BIN\0", 4) + data;
}

/// A chunk of 3DS: identifier, length, content.
std::string chunk(uint16_t id, const std::string& content) {
  return raw<uint16_t>({id}) + raw<uint32_t>({static_cast<uint32_t>(content.size() + 6)}) + content;
}

std::string threeDs() {
  const std::string faces = raw<uint16_t>({2, 0, 1, 2, 7, 0, 2, 3, 7});
  const std::string mesh = chunk(0x4100, chunk(0x4110, raw<uint16_t>({4}) + kSquare) + chunk(0x4120, faces));
  return chunk(
      0x4D4D, chunk(0x0002, raw<uint32_t>({3})) + chunk(0x3D3D, chunk(0x4000, std::string("a\0", 2) + mesh)));
}

std::string binaryStl() {
  const std::string facet = raw<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0}) + raw<uint16_t>({0});
  return std::string(80, ' ') + raw<uint32_t>({2}) + facet + facet;
}

std::string ply(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
         "property list uchar int vertex_indices\nend_header\n";
}

const char* const kCollada =
    R"(<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><up_axis>Y_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count="9">0 0 0 1 0 0 0 1 0</float_array>
<technique_common><accessor source="#pa" count="3" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="1"><input semantic="VERTEX" source="#v" offset="0"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>)";

class MeshFormat : public testing::TestWithParam<Parser> {};

Parser format(const std::string& name, const std::string& extension, const std::vector<std::string>& corpus,
              Mutate mutate = mutateText) {
  return {.name = name, .extension = extension, .corpus = corpus, .mutate = mutate};
}

TEST_P(MeshFormat, IsReadOrRefused) {
  Parser parser = GetParam();
  parser.rounds = 100;
  parser.read = [](const std::string& path) {
    const scene::ImportedMesh in = scene::importMesh(path, {.memoryMiB = 512.0, .seconds = 1.0});
    for (const glm::dvec3& p : in.mesh.positions)
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        throw Violation{"a vertex is not finite"};
    for (const glm::uvec3& t : in.mesh.triangles)
      if (std::max({t.x, t.y, t.z}) >= in.mesh.positions.size())
        throw Violation{"a triangle without its vertex"};
    for (const scene::Part& part : in.parts)
      if (part.firstTriangle + part.triangleCount > in.mesh.triangles.size() ||
          part.material >= in.materials.size())
        throw Violation{"a part without its triangles or its material"};
  };
  expectRobust(parser);
}

INSTANTIATE_TEST_SUITE_P(
    Fuzz, MeshFormat,
    testing::Values(
        format("obj", ".obj",
               {"mtllib f.mtl\no a\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nusemtl m\n"
                "f 1/1/1 2/1/1 3/1/1 4/1/1\nf -1 -2 -3\nl 1 2\np 1\ng b\ns 1\nf 1//1 2//1 3//1\n"}),
        format("ply_text", ".ply", {ply("ascii") + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n"}),
        format("ply_binary", ".ply",
               {ply("binary_little_endian") + kSquare + "\4" + raw<int32_t>({0, 1, 2, 3})}, mutateBytes),
        format("off", ".off", {"OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"}),
        format("stl_text", ".stl",
               {"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                "endfacet\nendsolid a\n"}),
        format("stl_binary", ".stl", {binaryStl()}, mutateBytes),
        format(
            "gltf", ".gltf",
            {gltf(
                R"({"byteLength": 60, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAAgD8AAAAAAAABAAIAAAACAAMA"})")}),
        format("glb", ".glb", {glb()}, mutateBytes), format("3ds", ".3ds", {threeDs()}, mutateBytes),
        format("collada", ".dae", {kCollada})),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace limen::fuzz

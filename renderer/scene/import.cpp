// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/import.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <bit>
#include <cassert>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <unordered_map>

#include "experiments/base/error.h"
#include "renderer/scene/shapes.h"

namespace limen::scene {
namespace {

const char* const kMend = "export it again as OBJ, PLY or glTF with triangles or polygons";

struct PositionHash {
  size_t operator()(const glm::dvec3& p) const {
    uint64_t hash = 0x9e3779b97f4a7c15U;
    for (int axis = 0; axis < 3; ++axis) {
      hash ^= std::bit_cast<uint64_t>(p[axis]);
      hash *= 0xff51afd7ed558ccdU;
      hash ^= hash >> 32;
    }
    return static_cast<size_t>(hash);
  }
};

/// Collects the triangles of a node graph.
class Collector {
 public:
  Collector(const aiScene& source, ImportedMesh& out) : source_(source), out_(out) {
    for (unsigned i = 0; i < source.mNumMaterials; ++i)
      out.materials.push_back(material(*source.mMaterials[i]));
  }

  void node(const aiNode& node, const glm::dmat4& parent) {
    const glm::dmat4 world = parent * matrix(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) mesh(*source_.mMeshes[node.mMeshes[i]], node, world);
    for (unsigned i = 0; i < node.mNumChildren; ++i) this->node(*node.mChildren[i], world);
  }

 private:
  static glm::dmat4 matrix(const aiMatrix4x4& m) {
    glm::dmat4 out;
    for (unsigned row = 0; row < 4; ++row)
      for (unsigned column = 0; column < 4; ++column)
        out[static_cast<int>(column)][static_cast<int>(row)] = static_cast<double>(m[row][column]);
    return out;
  }

  static Material material(const aiMaterial& source) {
    Material out;
    out.name = source.GetName().C_Str();
    aiColor3D diffuse;
    // Assimp invents a material for files that have none; it says nothing about the surface.
    if (out.name != AI_DEFAULT_MATERIAL_NAME && source.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) == AI_SUCCESS)
      for (int channel = 0; channel < 3; ++channel) {
        const float value = diffuse[static_cast<unsigned>(channel)];
        out.albedo[channel] = std::isfinite(value) ? std::clamp(value, 0.0F, 1.0F) : out.albedo[channel];
      }
    return out;
  }

  void mesh(const aiMesh& source, const aiNode& node, const glm::dmat4& world) {
    Part part;
    part.name = source.mName.length > 0 ? source.mName.C_Str() : node.mName.C_Str();
    part.firstTriangle = static_cast<uint32_t>(out_.mesh.triangles.size());
    part.material = source.mMaterialIndex;
    std::vector<uint32_t> index(source.mNumVertices);
    for (unsigned i = 0; i < source.mNumVertices; ++i) index[i] = vertex(world, source.mVertices[i]);
    // A mirroring transform turns the surface inside out; swapping two corners undoes that.
    const bool mirrored = glm::determinant(glm::dmat3(world)) < 0.0;
    for (unsigned i = 0; i < source.mNumFaces; ++i) {
      const aiFace& face = source.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines
      glm::uvec3 triangle(index[face.mIndices[0]], index[face.mIndices[1]], index[face.mIndices[2]]);
      if (mirrored) std::swap(triangle.y, triangle.z);
      out_.mesh.triangles.push_back(triangle);
    }
    part.triangleCount = static_cast<uint32_t>(out_.mesh.triangles.size()) - part.firstTriangle;
    if (part.triangleCount > 0) out_.parts.push_back(std::move(part));
  }

  uint32_t vertex(const glm::dmat4& world, const aiVector3D& local) {
    // Adding 0 makes -0 equal to 0 bitwise.
    const glm::dvec3 position = glm::dvec3(world * glm::dvec4(local.x, local.y, local.z, 1.0)) + 0.0;
    const auto [entry, fresh] = known_.emplace(position, static_cast<uint32_t>(out_.mesh.positions.size()));
    if (fresh) out_.mesh.positions.push_back(position);
    return entry->second;
  }

  const aiScene& source_;
  ImportedMesh& out_;
  std::unordered_map<glm::dvec3, uint32_t, PositionHash> known_;
};

/// A text PLY that ends early would be read with its last face repeated. The format has one line per element.
void refuseCutPly(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  size_t expected = 0, found = 0;
  bool text = false, body = false;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string first, second;
    words >> first >> second;
    if (body) {
      found += !first.empty();
    } else if (first == "format") {
      text = second == "ascii";
      if (!text) return;
    } else if (first == "element") {
      size_t count = 0;
      words >> count;
      expected += count;
    } else if (first == "end_header") {
      body = true;
    }
  }
  if (text && found < expected)
    throw Error(
        "the file ends after " + std::to_string(found) + " of " + std::to_string(expected) + " elements",
        path, "copy it again, completely");
}

/// Before anything walks the indices.
void refuseBroken(const aiScene& source, const std::string& path) {
  for (unsigned m = 0; m < source.mNumMeshes; ++m) {
    const aiMesh& mesh = *source.mMeshes[m];
    for (unsigned i = 0; i < mesh.mNumFaces; ++i)
      for (unsigned k = 0; k < mesh.mFaces[i].mNumIndices; ++k)
        if (mesh.mFaces[i].mIndices[k] >= mesh.mNumVertices)
          throw Error("face " + std::to_string(i + 1) + " of mesh " + std::to_string(m + 1) +
                          " uses a vertex that does not exist",
                      path, kMend);
  }
}

void refuseNonFinite(const Mesh& mesh, const std::string& path) {
  const auto broken = std::count_if(mesh.positions.begin(), mesh.positions.end(), [](const glm::dvec3& p) {
    return !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  });
  if (broken > 0)
    throw Error(std::to_string(broken) + " vertices have coordinates that are not finite", path, kMend);
}

/// Removes vertices that only points and lines used.
void dropUnused(Mesh& mesh) {
  std::vector<uint32_t> moved(mesh.positions.size(), 0);
  for (const glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) moved[triangle[corner]] = 1;
  uint32_t kept = 0;
  for (size_t i = 0; i < moved.size(); ++i) {
    if (moved[i] == 0) continue;
    mesh.positions[kept] = mesh.positions[i];
    moved[i] = kept++;
  }
  mesh.positions.resize(kept);
  for (glm::uvec3& triangle : mesh.triangles)
    for (int corner = 0; corner < 3; ++corner) triangle[corner] = moved[triangle[corner]];
}

}  // namespace

ImportedMesh importMesh(const std::string& path) {
  if (!std::filesystem::is_regular_file(path))
    throw Error("no such mesh file", path, "check the path; it is relative to the working directory");
  if (!std::ifstream(path)) throw Error("cannot read the mesh file", path, "check its permissions");

  if (std::filesystem::path(path).extension() == ".ply") refuseCutPly(path);
  Assimp::Importer importer;
  const aiScene* source = importer.ReadFile(path, 0);
  if (source == nullptr || source->mRootNode == nullptr)
    throw Error(std::string("not a readable mesh: ") + importer.GetErrorString(), path, kMend);
  refuseBroken(*source, path);
  source = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (source == nullptr)
    throw Error(std::string("cannot triangulate: ") + importer.GetErrorString(), path, kMend);

  ImportedMesh out;
  Collector(*source, out).node(*source->mRootNode, glm::dmat4(1.0));
  refuseNonFinite(out.mesh, path);
  if (out.mesh.triangles.empty()) throw Error("the file has no triangles", path, kMend);
  if (out.materials.empty()) out.materials.push_back({});
  dropUnused(out.mesh);
  return out;
}

std::string installedModel(const std::string& file) {
  const std::string path = "/usr/share/glmark2/models/" + file;
  if (!std::filesystem::exists(path))
    throw Error("the model is not installed", path, "install the package glmark2-data");
  return path;
}

void turnZUpToYUp(Mesh& mesh) {
  for (glm::dvec3& p : mesh.positions) p = {p.x, p.z, -p.y};
}

void standOnGround(Mesh& mesh, double height) {
  Bounds bounds;
  for (const glm::dvec3& position : mesh.positions) bounds.extend(position);
  if (bounds.empty()) return;
  const glm::dvec3 foot(bounds.centre().x, bounds.low.y, bounds.centre().z);
  const double found = bounds.high.y - bounds.low.y;
  const double scale = height > 0.0 && found > 0.0 ? height / found : 1.0;
  for (glm::dvec3& position : mesh.positions) position = (position - foot) * scale;
}

void addImported(Scene& scene, const ImportedMesh& imported) {
  const auto firstTriangle = static_cast<uint32_t>(scene.mesh.triangles.size());
  const auto firstMaterial = static_cast<uint32_t>(scene.materials.size());
  append(scene.mesh, imported.mesh);
  scene.materials.insert(scene.materials.end(), imported.materials.begin(), imported.materials.end());
  for (Part part : imported.parts) {
    part.firstTriangle += firstTriangle;
    part.material += firstMaterial;
    assert(part.material < scene.materials.size());
    scene.parts.push_back(std::move(part));
  }
}

}  // namespace limen::scene

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/mesh_import/read_mesh_file.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <algorithm>
#include <array>
#include <assimp/Importer.hpp>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <new>
#include <sstream>
#include <string_view>
#include <unordered_map>

#include "experiments/base/error.h"
#include "experiments/base/file_references.h"

namespace limen::scene {
namespace {

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
    // Assimp invents a material for files that have none; what it invents is no statement about the surface.
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
    // A mirroring transform turns the surface inside out; so does swapping two corners.
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
    // Adding 0 makes -0 the same place as 0.
    const glm::dvec3 position = glm::dvec3(world * glm::dvec4(local.x, local.y, local.z, 1.0)) + 0.0;
    const auto [entry, fresh] = known_.emplace(position, static_cast<uint32_t>(out_.mesh.positions.size()));
    if (fresh) out_.mesh.positions.push_back(position);
    return entry->second;
  }

  const aiScene& source_;
  ImportedMesh& out_;
  std::unordered_map<glm::dvec3, uint32_t, PositionHash> known_;
};

/// A text PLY that ends early would be read with its last face repeated. One line an element, as the format
/// has it.
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
    throw Error("the file ends after " + std::to_string(found) + " of " + std::to_string(expected) +
                " elements: copy it again, whole");
}

/// Before anything walks the indices.
void refuseBroken(const aiScene& source) {
  for (unsigned m = 0; m < source.mNumMeshes; ++m) {
    const aiMesh& mesh = *source.mMeshes[m];
    for (unsigned i = 0; i < mesh.mNumFaces; ++i)
      for (unsigned k = 0; k < mesh.mFaces[i].mNumIndices; ++k)
        if (mesh.mFaces[i].mIndices[k] >= mesh.mNumVertices)
          throw Error("face " + std::to_string(i + 1) + " of mesh " + std::to_string(m + 1) +
                      " uses a vertex that does not exist");
  }
}

/// Corners of a polygon that lie where the one before lies are left out; what has fewer than three places
/// then has no area, and is what triangulation fails on. Triangles stay as they are.
void dropDegeneratePolygons(const aiScene& source) {
  for (unsigned m = 0; m < source.mNumMeshes; ++m) {
    aiMesh& mesh = *source.mMeshes[m];
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices <= 3) continue;
      const auto at = [&](unsigned corner) { return mesh.mVertices[face.mIndices[corner]]; };
      unsigned kept = 0;
      for (unsigned k = 0; k < face.mNumIndices; ++k)
        if (kept == 0 || at(k) != at(kept - 1)) face.mIndices[kept++] = face.mIndices[k];
      while (kept > 1 && at(kept - 1) == at(0)) --kept;
      unsigned places = kept;
      if (kept == 4 && (at(0) == at(2) || at(1) == at(3))) places = 2;
      // A face of one corner is a point, which no surface has.
      face.mNumIndices = places < 3 ? 1 : kept;
    }
  }
}

void refuseNonFinite(const Mesh& mesh) {
  const auto broken = std::count_if(mesh.positions.begin(), mesh.positions.end(), [](const glm::dvec3& p) {
    return !(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
  });
  if (broken > 0) throw Error(std::to_string(broken) + " vertices have coordinates that are not finite");
}

/// Vertices that only points and lines used.
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

/// Opens the mesh file and those that it refers to, nothing else; more files may take more memory.
class NamedFilesOnly : public Assimp::DefaultIOSystem {
 public:
  NamedFilesOnly(const std::string& path, const std::function<void(uint64_t)>& opening) : opening_(opening) {
    allowed_ = referencedFiles(path);
    allowed_.push_back(std::filesystem::path(path).lexically_normal().string());
  }
  bool Exists(const char* file) const override {
    const std::string path = std::filesystem::path(file).lexically_normal().string();
    std::error_code code;
    return std::find(allowed_.begin(), allowed_.end(), path) != allowed_.end() &&
           std::filesystem::is_regular_file(path, code);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (!Exists(file) || std::string_view(mode).find_first_of("wa+") != std::string_view::npos)
      return nullptr;
    std::error_code code;
    const auto size = std::filesystem::file_size(file, code);
    if (code) return nullptr;
    opening_(size);
    return DefaultIOSystem::Open(file, mode);
  }

 private:
  std::vector<std::string> allowed_;
  const std::function<void(uint64_t)>& opening_;
};

/// Assimp guesses from the content, too, and knows dozens of formats.
void keepKnownFormats(Assimp::Importer& importer) {
  for (size_t i = importer.GetImporterCount(); i-- > 0;) {
    const aiImporterDesc* description = importer.GetImporterInfo(i);
    bool known = false;
    if (description != nullptr) {
      std::istringstream words(description->mFileExtensions);
      for (std::string word; words >> word;)
        known = known || std::any_of(kMeshExtensions.begin(), kMeshExtensions.end(),
                                     [&](const char* extension) { return "." + word == extension; });
    }
    if (!known) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

/// Assimp catches exceptions and keeps their text.
[[noreturn]] void throwFailure(const std::string& what, const Assimp::Importer& importer) {
  const std::string words = importer.GetErrorString();
  if (words.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
  throw Error(what + words);
}

}  // namespace

ImportedMesh readMeshFile(const std::string& path, const std::function<void(uint64_t)>& opening) {
  Assimp::Importer importer;
  keepKnownFormats(importer);
  importer.SetIOHandler(new NamedFilesOnly(path, opening));  // the importer deletes it
  opening(0);
  if (std::filesystem::path(path).extension() == ".ply") refuseCutPly(path);
  const aiScene* source = importer.ReadFile(path, 0);
  if (source == nullptr || source->mRootNode == nullptr)
    throwFailure("not a mesh that can be read: ", importer);
  refuseBroken(*source);
  dropDegeneratePolygons(*source);
  source = importer.ApplyPostProcessing(aiProcess_Triangulate);
  if (source == nullptr) throwFailure("cannot triangulate: ", importer);

  ImportedMesh out;
  Collector(*source, out).node(*source->mRootNode, glm::dmat4(1.0));
  refuseNonFinite(out.mesh);
  if (out.mesh.triangles.empty()) throw Error("the file has no triangles");
  if (out.materials.empty()) out.materials.push_back({});
  dropUnused(out.mesh);
  return out;
}

}  // namespace limen::scene

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/import.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <filesystem>
#include <fstream>

#include "experiments/base/error.h"
#include "renderer/scene/mesh_import/import_process.h"
#include "renderer/scene/shapes.h"

namespace limen::scene {
namespace {

bool isMeshFormat(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(kMeshExtensions.begin(), kMeshExtensions.end(), extension) != kMeshExtensions.end();
}

}  // namespace

ImportedMesh importMesh(const std::string& path, const ImportLimits& limits) {
  std::error_code code;
  if (std::filesystem::exists(path, code) && !std::filesystem::is_regular_file(path, code))
    throw Error("is not a file but a folder, a pipe or a device", path, "name a mesh file");
  if (!std::filesystem::is_regular_file(path, code))
    throw Error("no such mesh file", path, "check the path; it is taken relative to the working folder");
  if (!isMeshFormat(path))
    throw Error("is not in a supported format", path,
                "export it as OBJ, PLY, glTF (gltf, glb), OFF, STL, 3DS or COLLADA (dae)");
  if (!std::ifstream(path)) throw Error("cannot read the mesh file", path, "check its permissions");
  return importInProcess(path, limits);
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

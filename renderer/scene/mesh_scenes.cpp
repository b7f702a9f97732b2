// SPDX-License-Identifier: BSD-3-Clause
// Meshes over a ground plane: any file, and the three that come with the package glmark2-data.
#include <algorithm>
#include <cmath>

#include "experiments/base/error.h"
#include "renderer/scene/import.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

/// Largest distance from the y axis.
double reachOf(const Mesh& mesh) {
  double reach = 0.0;
  for (const glm::dvec3& p : mesh.positions) reach = std::max(reach, std::hypot(p.x, p.z));
  return reach;
}

Scene overGround(const ImportedMesh& imported, double meshHeight, bool ground) {
  Scene scene;
  const double reach = reachOf(imported.mesh);
  // A flat mesh has no height; the light's size then follows its extent.
  const double height = std::max(meshHeight, 0.1 * reach);
  if (ground) addGround(scene, 8.0 * std::max(height, reach));
  addImported(scene, imported);
  frameStanding(scene, height, reach);
  return scene;
}

enum class UpAxis { Y, Z };
constexpr EnumNames<UpAxis, 2> enumNames(UpAxis) { return {{{{UpAxis::Y, "y"}, {UpAxis::Z, "z"}}}}; }

struct MeshSettings {
  FilePath file;
  UpAxis up = UpAxis::Y;
  bool ground = true;
  static const SettingsTable<MeshSettings>& table() {
    using S = MeshSettings;
    static const SettingsTable<S> kTable = {
        {&S::file, "file", FileIs::Required, "OBJ, PLY, glTF or 3DS file"},
        {&S::up, "up", "Axis of the file that points up"},
        {&S::ground, "ground", "Adds a plane that only receives shadows"}};
    return kTable;
  }
};

Scene buildMesh(const MeshSettings& settings) {
  ImportedMesh imported = importMesh(settings.file.path);
  if (settings.up == UpAxis::Z) turnZUpToYUp(imported.mesh);
  standOnGround(imported.mesh, 0.0);
  double height = 0.0;
  for (const glm::dvec3& p : imported.mesh.positions) height = std::max(height, p.y);
  return overGround(imported, height, settings.ground);
}

/// 3DS has z up and is read that way, but the cat was saved with y up: as read, it lies on its back.
enum class Turned { No, Over };

Scene buildModel(const std::string& file, Turned turned) {
  ImportedMesh imported = importMesh(installedModel(file));
  if (turned == Turned::Over)
    for (glm::dvec3& p : imported.mesh.positions) p = {p.x, -p.z, p.y};
  constexpr double kHeight = 1.0;
  standOnGround(imported.mesh, kHeight);
  return overGround(imported, kHeight, true);
}

const RegisteredScene<MeshSettings> kMeshRegistered{
    {.name = "mesh",
     .version = 1,
     .summary = "A mesh from a file, standing on a ground plane, in the file's own units",
     .source = "bench"},
    buildMesh};

const RegisteredScene<NoSettings> kBunny{
    {.name = "bunny",
     .version = 1,
     .summary = "Stanford bunny of height 1 over a plane of 8 x 8 (package glmark2-data)",
     .source = "Stanford 3D Scanning Repository; stand-in for Schwarz 2009, Fig. 4.16"},
    [](const NoSettings&) { return buildModel("bunny.obj", Turned::No); }};

const RegisteredScene<NoSettings> kHorse{
    {.name = "horse",
     .version = 1,
     .summary = "Horse of height 1 over a plane: thin legs (package glmark2-data)",
     .source = "stand-in for Schwarz 2009, Fig. 4.28"},
    [](const NoSettings&) { return buildModel("horse.3ds", Turned::No); }};

const RegisteredScene<NoSettings> kCat{{.name = "cat",
                                        .version = 1,
                                        .summary = "Cat of height 1 over a plane (package glmark2-data)",
                                        .source = "stand-in for Schwarz 2009, Fig. 4.28"},
                                       [](const NoSettings&) { return buildModel("cat.3ds", Turned::Over); }};

}  // namespace
}  // namespace limen::scene

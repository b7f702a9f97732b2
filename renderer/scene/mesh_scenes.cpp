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

Scene buildMesh(const ParameterValues& values) {
  ImportedMesh imported = importMesh(values.text("file"));
  if (values.text("up") == "z") turnZUpToYUp(imported.mesh);
  standOnGround(imported.mesh, 0.0);
  double height = 0.0;
  for (const glm::dvec3& p : imported.mesh.positions) height = std::max(height, p.y);
  return overGround(imported, height, values.boolean("ground"));
}

/// 3DS has z up and is read so, but the cat was saved with y up: read, it lies on its back.
enum class Turned { No, Over };

Scene buildModel(const std::string& file, Turned turned) {
  ImportedMesh imported = importMesh(installedModel(file));
  if (turned == Turned::Over)
    for (glm::dvec3& p : imported.mesh.positions) p = {p.x, -p.z, p.y};
  constexpr double kHeight = 1.0;
  standOnGround(imported.mesh, kHeight);
  return overGround(imported, kHeight, true);
}

const Registered<SceneInfo> kMeshRegistered{
    SceneInfo{.name = "mesh",
              .version = 1,
              .summary = "A mesh from a file, standing on a ground plane, in the file's own units",
              .source = "bench",
              .parameters = {fileParameter("file", "OBJ, PLY, glTF or 3DS file"),
                             choiceParameter("up", "y", {"y", "z"}, "Axis of the file that points up"),
                             booleanParameter("ground", true, "Adds a plane that only receives shadows")},
              .build = buildMesh}};

const Registered<SceneInfo> kBunny{
    SceneInfo{.name = "bunny",
              .version = 1,
              .summary = "Stanford bunny of height 1 over a plane of 8 x 8 (package glmark2-data)",
              .source = "Stanford 3D Scanning Repository; stand-in for Schwarz 2009, Fig. 4.16",
              .parameters = {},
              .build = [](const ParameterValues&) { return buildModel("bunny.obj", Turned::No); }}};

const Registered<SceneInfo> kHorse{
    SceneInfo{.name = "horse",
              .version = 1,
              .summary = "Horse of height 1 over a plane: thin legs (package glmark2-data)",
              .source = "stand-in for Schwarz 2009, Fig. 4.28",
              .parameters = {},
              .build = [](const ParameterValues&) { return buildModel("horse.3ds", Turned::No); }}};

const Registered<SceneInfo> kCat{
    SceneInfo{.name = "cat",
              .version = 1,
              .summary = "Cat of height 1 over a plane (package glmark2-data)",
              .source = "stand-in for Schwarz 2009, Fig. 4.28",
              .parameters = {},
              .build = [](const ParameterValues&) { return buildModel("cat.3ds", Turned::Over); }}};

}  // namespace
}  // namespace limen::scene

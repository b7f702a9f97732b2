// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "renderer/scene/import.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kHallHalfWidth = 2.2, kHallHalfLength = 4.2, kHallTop = 2.6, kModelHeight = 1.1;

struct ModelsHallSettings {
  int columnsPerRow = 6, segments = 48;
  static const SettingsTable<ModelsHallSettings>& table() {
    using S = ModelsHallSettings;
    static const SettingsTable<S> kTable = {
        {&S::columnsPerRow, "columns_per_row", {2, 32}, "columns", "Columns in each of the two rows"},
        {&S::segments, "segments", {3, 128}, "segments", "Sides of a column's shaft"}};
    return kTable;
  }
};

Mesh hallOf(const ModelsHallSettings& settings) {
  const double w = kHallHalfWidth, l = kHallHalfLength, h = 0.5 * kHallTop;
  const glm::dvec3 x(w, 0.0, 0.0), y(0.0, h, 0.0), z(0.0, 0.0, l);
  Mesh hall = cardGrid({0.0, 0.0, 0.0}, z, x, 32);
  append(hall, cardGrid({-w, h, 0.0}, y, z, 32));
  append(hall, cardGrid({w, h, 0.0}, z, y, 32));
  append(hall, cardGrid({0.0, h, -l}, x, y, 32));
  for (int i = 0; i < settings.columnsPerRow; ++i)
    for (const double side : {-1.0, 1.0}) {
      const glm::dvec3 foot(side * 1.6, 0.0, l * ((2.0 * i + 1.0) / settings.columnsPerRow - 1.0));
      append(hall, box(foot + glm::dvec3(-0.22, 0.0, -0.22), foot + glm::dvec3(0.22, 0.14, 0.22)));
      append(hall, frustum(foot + glm::dvec3(0.0, 0.14, 0.0), foot + glm::dvec3(0.0, kHallTop, 0.0), 0.17,
                           0.14, settings.segments));
    }
  return hall;
}

/// 3DS has z up; the cat was saved with y up and lies on its back as read.
Mesh modelAt(const char* file, bool turned, glm::dvec3 foot) {
  Mesh mesh = importMesh(installedModel(file)).mesh;
  if (turned)
    for (glm::dvec3& p : mesh.positions) p = {p.x, -p.z, p.y};
  standOnGround(mesh, kModelHeight);
  for (glm::dvec3& p : mesh.positions) p += foot;
  return mesh;
}

/// All of the hall receives, and the three models alone have anything to cast.
Scene buildModelsHall(const ModelsHallSettings& settings) {
  Scene scene;
  addPart(scene, "hall", hallOf(settings), {0.72F, 0.68F, 0.6F}, Role::ReceiverOnly);
  addPart(scene, "bunny", modelAt("bunny.obj", false, {-0.75, 0.0, 0.9}), {0.7F, 0.62F, 0.5F});
  addPart(scene, "cat", modelAt("cat.3ds", true, {0.75, 0.0, 0.5}), {0.5F, 0.62F, 0.7F});
  addPart(scene, "horse", modelAt("horse.3ds", false, {0.0, 0.0, -1.0}), {0.62F, 0.5F, 0.45F});
  scene.lights = {lightTowards({0.0, 4.5, 3.0}, {0.0, 0.4, 0.0}, glm::dvec2(0.8))};
  setStillCamera(scene, orbitCamera({0.0, 0.55, 0.0}, 5.2, 12.0, 20.0, 40.0));
  return scene;
}

const RegisteredScene<ModelsHallSettings> kModelsHall{
    {.name = "models_hall",
     .version = 1,
     .summary = "Bunny, cat and horse in a hall of columns that only receives (package glmark2-data)",
     .source = "stand-in for Gaitatzes 2012, Fig. 41 (Sponza Atrium with bunny, cow and elephant)"},
    buildModelsHall};

}  // namespace
}  // namespace limen::scene

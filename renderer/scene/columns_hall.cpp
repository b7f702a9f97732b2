// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kColumnPitch = 1.2, kAisle = 1.0, kHallHeight = 2.2;

/// Plinth, shaft and capital, each closed.
Mesh column(glm::dvec3 foot, int segments) {
  Mesh mesh = box(foot + glm::dvec3(-0.26, 0.0, -0.26), foot + glm::dvec3(0.26, 0.14, 0.26));
  append(mesh, frustum(foot + glm::dvec3(0.0, 0.14, 0.0), foot + glm::dvec3(0.0, kHallHeight - 0.16, 0.0),
                       0.2, 0.16, segments));
  append(mesh, box(foot + glm::dvec3(-0.24, kHallHeight - 0.16, -0.24),
                   foot + glm::dvec3(0.24, kHallHeight, 0.24)));
  return mesh;
}

/// Down the aisle and around, at eye height, with uneven times.
CameraPath walk(double length) {
  const double half = 0.5 * length;
  const auto key = [](double timeS, glm::dvec3 eye, glm::dvec3 target) {
    return CameraPath::Key{timeS, Camera{eye, target, {0.0, 1.0, 0.0}, 50.0}};
  };
  return {{key(0.0, {0.0, 1.6, half + 2.4}, {0.0, 0.7, half - 1.0}),
           key(2.0, {-0.3, 1.5, 0.6 * half}, {0.2, 0.5, 0.0}),
           key(3.5, {0.3, 1.5, 0.1 * half}, {-0.4, 0.4, -0.6 * half}),
           key(6.0, {0.0, 1.7, -0.5 * half}, {0.3, 0.3, -half - 0.5}),
           key(8.0, {0.0, 2.0, -0.8 * half}, {0.9, 0.2, -half - 1.2})}};
}

enum class HallMotion { Still, Walk };
constexpr EnumNames<HallMotion, 2> enumNames(HallMotion) {
  return {{{{HallMotion::Still, "still"}, {HallMotion::Walk, "walk"}}}};
}

struct ColumnsHallSettings {
  int columnsPerRow = 6, segments = 32;
  HallMotion motion = HallMotion::Still;
  static const SettingsTable<ColumnsHallSettings>& table() {
    using S = ColumnsHallSettings;
    static const SettingsTable<S> kTable = {
        {&S::columnsPerRow, "columns_per_row", {2, 32}, "columns", "Columns in each of the two rows"},
        {&S::segments, "segments", {3, 128}, "segments", "Sides of a column's shaft"},
        {&S::motion, "motion", "A still view from outside, or a walk of 8 s down the aisle"}};
    return kTable;
  }
};

/// Two rows of columns along z without a ceiling. The light is on the left, so that shadows cross the aisle,
/// and the longer the hall the higher the light, so that the whole ground is in front of it.
Scene buildColumnsHall(const ColumnsHallSettings& settings) {
  const int perRow = settings.columnsPerRow, segments = settings.segments;
  const double length = kColumnPitch * (perRow - 1);
  Mesh columns;
  for (int i = 0; i < perRow; ++i)
    for (const double side : {-1.0, 1.0})
      append(columns, column({side * kAisle, 0.0, 0.5 * length - kColumnPitch * i}, segments));
  Scene scene;
  const double ground = length + 14.0;
  addGround(scene, ground);
  addPart(scene, "columns", columns, {0.72F, 0.68F, 0.6F});
  scene.lights = {
      lightTowards(ground * glm::dvec3(-0.225, 0.4, 0.125), {0.0, 0.5, 0.0}, glm::dvec2(0.025 * ground))};
  if (settings.motion == HallMotion::Walk) {
    scene.camera = walk(length);
  } else {
    setStillCamera(scene, orbitCamera({0.3, 0.5, 0.3 * length}, 6.5, 14.0, 40.0, 40.0));
  }
  return scene;
}

const RegisteredScene<ColumnsHallSettings> kColumnsHallRegistered{
    {.name = "columns_hall",
     .version = 1,
     .summary = "Two rows of columns on a floor: long shadows over floor and other columns",
     .source = "bench"},
    buildColumnsHall};

}  // namespace
}  // namespace limen::scene

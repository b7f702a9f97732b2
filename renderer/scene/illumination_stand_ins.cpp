// SPDX-License-Identifier: BSD-3-Clause
// Stand-ins with the triangle counts of the scenes of Gaitatzes 2012, Table 2, which are not to be had: boxes
// and cards, from which light finds its way between many small surfaces.
#include <cmath>
#include <numbers>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

enum class StandIn { Test, Room, Arena, Hall };
constexpr EnumNames<StandIn, 4> enumNames(StandIn) {
  return {{{{StandIn::Test, "test"},
            {StandIn::Room, "room"},
            {StandIn::Arena, "arena"},
            {StandIn::Hall, "hall"}}}};
}

struct StandInSettings {
  StandIn of = StandIn::Room;
  double turnDeg = 0.0;
  static const SettingsTable<StandInSettings>& table() {
    using S = StandInSettings;
    static const SettingsTable<S> kTable = {
        {&S::of, "of", "48, 704, 10,220 or 66,454 triangles", "Gaitatzes 2012, Table 2"},
        {&S::turnDeg,
         "turn_deg",
         {0.0, 90.0},
         "deg",
         "About the vertical axis, against the axes of voxels",
         "the bench's own"}};
    return kTable;
  }
};

constexpr int kBoxTriangles = 12;

/// Walls that face inwards, with the front open: floor, ceiling, back and two sides, or fewer.
void addWalls(Scene& scene, glm::dvec3 half, int count) {
  using V = glm::dvec3;
  const V up(0.0, half.y, 0.0);
  const Mesh walls[] = {
      card(V(0.0), {half.x, 0, 0}, {0, 0, -half.z}), card(V(0, half.y, -half.z), {half.x, 0, 0}, up),
      card(V(-half.x, half.y, 0), {0, 0, -half.z}, up), card(V(half.x, half.y, 0), {0, 0, half.z}, up),
      card(V(0, 2.0 * half.y, 0), {half.x, 0, 0}, {0, 0, half.z})};
  const char* names[] = {"floor", "back", "left", "right", "ceiling"};
  const glm::vec3 colours[] = {
      glm::vec3(0.6F), glm::vec3(0.7F), {0.6F, 0.15F, 0.1F}, {0.15F, 0.4F, 0.15F}, glm::vec3(0.7F)};
  for (int i = 0; i < count; ++i) addPart(scene, names[i], walls[i], colours[i], Role::ReceiverOnly);
}

/// Steps of a stair, one box each, from the left of the room to its back.
void addSteps(Scene& scene, int count, glm::dvec3 half) {
  Mesh steps;
  for (int i = 0; i < count; ++i) {
    const double at = -0.9 * half.x + 1.8 * half.x * i / count, width = 1.5 * half.x / count;
    const double top = 1.2 * half.y * (i + 1) / count;
    append(steps, box({at, top - 0.06 * half.y, -0.95 * half.z}, {at + width, top, -0.5 * half.z}));
  }
  addPart(scene, "steps", steps, glm::vec3(0.55F));
}

/// Rings of seats, each higher than that before it.
void addSeats(Scene& scene, int count, glm::dvec3 half) {
  constexpr int kRings = 11;
  Mesh seats;
  for (int i = 0; i < count; ++i) {
    const int ring = i % kRings, places = (count + kRings - 1) / kRings;
    const double angle = 2.0 * std::numbers::pi * (i / kRings) / places;
    const double part = 0.45 + 0.5 * ring / kRings, top = half.y * (0.08 + 0.7 * ring / kRings);
    const glm::dvec3 middle(part * half.x * std::cos(angle), 0.0, part * half.z * std::sin(angle));
    const glm::dvec3 reach(0.012 * half.x, 0.0, 0.012 * half.z);
    append(seats, box(middle - reach, middle + reach + glm::dvec3(0.0, top, 0.0)));
  }
  addPart(scene, "seats", seats, glm::vec3(0.5F, 0.45F, 0.35F));
}

/// Columns in two rows on two floors, of drums that are boxes in turn.
void addColumns(Scene& scene, int count, glm::dvec3 half) {
  constexpr int kColumns = 29;
  Mesh drums;
  const int each = (count + kColumns - 1) / kColumns;
  for (int i = 0; i < count; ++i) {
    const int column = i % kColumns, drum = i / kColumns;
    const double side = column % 2 == 0 ? -0.55 : 0.55;
    const glm::dvec3 foot(side * half.x, 1.9 * half.y * drum / each,
                          half.z * (-0.9 + 1.8 * (column / 2) / (kColumns / 2)));
    const double wide = 0.03 * half.x * (1.0 + 0.3 * std::sin(0.7 * drum));
    append(drums, box(foot - glm::dvec3(wide, 0, wide), foot + glm::dvec3(wide, 1.9 * half.y / each, wide)));
  }
  addPart(scene, "columns", drums, glm::vec3(0.65F, 0.6F, 0.5F));
}

Scene buildStandIn(const StandInSettings& settings) {
  Scene scene;
  const glm::dvec3 half = settings.of == StandIn::Hall    ? glm::dvec3(4.0, 2.5, 8.0)
                          : settings.of == StandIn::Arena ? glm::dvec3(6.0, 2.0, 6.0)
                                                          : glm::dvec3(2.0, 1.25, 2.0);
  const int total = settings.of == StandIn::Test    ? 48
                    : settings.of == StandIn::Room  ? 704
                    : settings.of == StandIn::Arena ? 10220
                                                    : 66454;
  // As many walls as leave a multiple of a box's triangles.
  const int walls = settings.of == StandIn::Hall ? 5 : 4;
  if (settings.of == StandIn::Test) {
    addWalls(scene, half, 0);
    addPart(scene, "floor", box({-2, -0.2, -2}, {2, 0, 2}), glm::vec3(0.6F));
    addPart(scene, "back", box({-2, 0, -2.2}, {2, 2.5, -2}), glm::vec3(0.7F));
    addPart(scene, "left", box({-2.2, 0, -2}, {-2, 2.5, 2}), glm::vec3(0.6F, 0.15F, 0.1F));
    addPart(scene, "block", box({0, 0, -1}, {1, 1, 0}), glm::vec3(0.7F));
  } else {
    addWalls(scene, half, walls);
    const int boxes = (total - 2 * walls) / kBoxTriangles;
    if (settings.of == StandIn::Room) addSteps(scene, boxes, half);
    if (settings.of == StandIn::Arena) addSeats(scene, boxes, half);
    if (settings.of == StandIn::Hall) addColumns(scene, boxes, half);
  }
  const double angle = glm::radians(settings.turnDeg), c = std::cos(angle), s = std::sin(angle);
  const auto turned = [&](glm::dvec3 p) { return glm::dvec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x); };
  for (glm::dvec3& position : scene.mesh.positions) position = turned(position);
  scene.lights = {lightTowards(turned({0.3 * half.x, 1.7 * half.y, 0.2 * half.z}),
                               turned({0.3 * half.x, 0.0, 0.1 * half.z}), glm::dvec2(0.2))};
  setStillCamera(
      scene,
      {turned({0.0, 1.1 * half.y, 2.9 * half.z}), turned({0.0, 0.9 * half.y, 0.0}), {0.0, 1.0, 0.0}, 45.0});
  return scene;
}

const RegisteredScene<StandInSettings> kStandInRegistered{
    {.name = "global_illumination/stand_in",
     .version = 1,
     .summary =
         "Scenes of boxes with the triangle counts of a published table, to be turned against the grid",
     .source = "stand-ins for Gaitatzes 2012, section 5.6, Table 2"},
    buildStandIn};

}  // namespace
}  // namespace limen::scene

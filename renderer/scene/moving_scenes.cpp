// SPDX-License-Identifier: BSD-3-Clause
// Scenes whose parts move while others stand still or are hidden, for what is kept from frame to frame: a box
// before a wall, a door that turns before a hidden wall. After Gaitatzes 2012, Fig. 74 and 77.
#include <cmath>
#include <numbers>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr glm::vec3 kStill{0.65F, 0.62F, 0.58F}, kMoves{0.25F, 0.5F, 0.7F};

PartMotion motionOfLast(const Scene& scene) {
  PartMotion motion;
  motion.part = static_cast<uint32_t>(scene.parts.size() - 1);
  return motion;
}

struct MovingBoxSettings {
  double side = 0.5, thickness = 0.5, reach = 1.2, periodS = 4.0, distance = 4.5;
  static const SettingsTable<MovingBoxSettings>& table() {
    using S = MovingBoxSettings;
    static const SettingsTable<S> kTable = {
        {&S::side, "side", {0.01, 1.0}, "m", "Of the box, across and up"},
        {&S::thickness, "thickness", {0.0001, 1.0}, "m", "Of the box, along the way"},
        {&S::reach, "reach", {0.0, 1.5}, "m", "That it moves to both sides"},
        {&S::periodS, "period_s", {0.001, 60.0}, "s", "Of its motion to and fro"},
        {&S::distance,
         "distance",
         {2.5, 100.0},
         "m",
         "From the camera to the box; a narrower view shows as much"}};
    return kTable;
  }
};

Scene buildMovingBox(const MovingBoxSettings& settings) {
  Scene scene;
  addPart(scene, "wall", card({0.0, 1.25, -2.0}, {2.0, 0.0, 0.0}, {0.0, 1.25, 0.0}), kStill);
  addPart(scene, "floor", card({0.0, 0.0, 0.0}, {0.0, 0.0, 2.0}, {2.0, 0.0, 0.0}), kStill);
  const glm::dvec3 half = 0.5 * glm::dvec3(settings.thickness, settings.side, settings.side);
  const glm::dvec3 middle(0.013, 1.207, 0.011);
  addPart(scene, "box", box(middle - half, middle + half), kMoves);
  PartMotion motion = motionOfLast(scene);
  motion.travel = {settings.reach, 0.0, 0.0};
  motion.periodS = settings.periodS;
  scene.motions = {motion};
  scene.lights = {lightTowards({1.0, 3.6, 2.4}, {0.0, 1.0, -0.5}, glm::dvec2(0.3))};
  const double fov = 2.0 * glm::degrees(std::atan(1.9 / settings.distance));
  setStillCamera(scene, {{0.0, 1.4, settings.distance}, {0.0, 1.2, 0.0}, {0.0, 1.0, 0.0}, fov});
  return scene;
}

const RegisteredScene<MovingBoxSettings> kMovingBoxRegistered{
    {.name = "moving/box",
     .version = 1,
     .summary = "Box that moves to and fro before a wall; all that it uncovers is seen at once",
     .source = "bench"},
    buildMovingBox};

struct MovingDoorSettings {
  double turnDegS = 90.0, startDeg = 90.0;
  bool figure = true;
  static const SettingsTable<MovingDoorSettings>& table() {
    using S = MovingDoorSettings;
    static const SettingsTable<S> kTable = {
        {&S::turnDegS, "turn_deg_s", {0.0, 3600.0}, "deg/s", "Of the door about its middle"},
        {&S::startDeg, "start_deg", {0.0, 360.0}, "deg", "Of the door at time 0; 0: closed, 90: open"},
        {&S::figure, "figure", "A figure walks before the door, its arms turning about their shoulders"}};
    return kTable;
  }
};

void addFigure(Scene& scene) {
  const auto add = [&](const char* name, glm::dvec3 low, glm::dvec3 high) {
    addPart(scene, name, box(low, high), kMoves);
    PartMotion motion = motionOfLast(scene);
    motion.travel = {1.1, 0.0, 0.0};
    motion.periodS = 5.0;
    scene.motions.push_back(motion);
  };
  add("body", {-0.16, 0.5, 1.0}, {0.16, 1.15, 1.2});
  add("head", {-0.1, 1.2, 1.02}, {0.1, 1.42, 1.18});
  for (const double side : {-1.0, 1.0}) {
    const double x = 0.23 * side;
    add("arm", {x - 0.05, 0.65, 1.05}, {x + 0.05, 1.12, 1.15});
    scene.motions.back().pivot = {x, 1.07, 1.1};
    scene.motions.back().axis = {1.0, 0.0, 0.0};
    scene.motions.back().turnDegS = 120.0 * side;
  }
  for (const double side : {-1.0, 1.0}) {
    const double x = 0.09 * side;
    add("leg", {x - 0.06, 0.02, 1.04}, {x + 0.06, 0.48, 1.16});
  }
}

Scene buildMovingDoor(const MovingDoorSettings& settings) {
  constexpr double kDoorHalfWidth = 1.8, kDoorHeight = 2.5, kDoorBack = -1.8, kDoorFront = 2.2,
                   kDoorOpening = 0.6, kDoorTop = 2.05;
  Scene scene;
  const double middleZ = 0.5 * (kDoorBack + kDoorFront), halfZ = 0.5 * (kDoorFront - kDoorBack);
  addPart(scene, "floor", card({0.0, 0.0, middleZ}, {0.0, 0.0, halfZ}, {kDoorHalfWidth, 0.0, 0.0}), kStill);
  addPart(
      scene, "hidden wall",
      card({0.0, 0.5 * kDoorHeight, kDoorBack}, {kDoorHalfWidth, 0.0, 0.0}, {0.0, 0.5 * kDoorHeight, 0.0}),
      {0.7F, 0.3F, 0.2F});
  const double half = 0.5 * (kDoorHalfWidth - kDoorOpening);
  for (const double side : {-1.0, 1.0})
    addPart(scene, "partition",
            card({side * (kDoorOpening + half), 0.5 * kDoorHeight, 0.0}, {half, 0.0, 0.0},
                 {0.0, 0.5 * kDoorHeight, 0.0}),
            kStill);
  addPart(scene, "lintel",
          card({0.0, 0.5 * (kDoorTop + kDoorHeight), 0.0}, {kDoorOpening, 0.0, 0.0},
               {0.0, 0.5 * (kDoorHeight - kDoorTop), 0.0}),
          kStill);
  addPart(scene, "door", box({-0.57, 0.03, -0.02}, {0.57, 2.02, 0.02}), kMoves);
  PartMotion door = motionOfLast(scene);
  door.turnDegS = settings.turnDegS;
  door.startS = settings.turnDegS > 0.0 ? settings.startDeg / settings.turnDegS : 0.0;
  scene.motions = {door};
  if (settings.figure) addFigure(scene);
  scene.lights = {lightTowards({0.8, 2.4, 1.9}, {0.0, 0.6, -0.6}, glm::dvec2(0.3))};
  setStillCamera(scene, {{0.25, 1.5, 4.4}, {0.0, 1.1, 0.0}, {0.0, 1.0, 0.0}, 44.0});
  return scene;
}

const RegisteredScene<MovingDoorSettings> kMovingDoorRegistered{
    {.name = "moving/door",
     .version = 1,
     .summary =
         "Door that turns about its middle before a wall that it hides, and a figure of parts that moves",
     .source = "after Gaitatzes 2012, Fig. 74"},
    buildMovingDoor};

struct MovingWheelSettings {
  int spokes = 9;
  double thickness = 0.01, height = 0.05, turnDegS = 45.0, reach = 0.2, periodS = 5.0, startS = 0.0;
  static const SettingsTable<MovingWheelSettings>& table() {
    using S = MovingWheelSettings;
    static const SettingsTable<S> kTable = {
        {&S::spokes, "spokes", {1, 64}, "", "Of the wheel"},
        {&S::thickness, "thickness", {0.0001, 0.1}, "m", "Of a spoke, up and across; it is 1 long"},
        {&S::height, "height", {0.001, 1.0}, "m", "Of the spokes above the ground"},
        {&S::turnDegS,
         "turn_deg_s",
         {0.0, 3600.0},
         "deg/s",
         "Of the wheel about its axis, which stands upright"},
        {&S::reach, "reach", {0.0, 1.0}, "m", "That the wheel moves to both sides"},
        {&S::periodS, "period_s", {0.001, 60.0}, "s", "Of its motion to and fro"},
        {&S::startS, "start_s", {0.0, 600.0}, "s", "Time of the motion at which the scene begins"}};
    return kTable;
  }
};

Scene buildMovingWheel(const MovingWheelSettings& settings) {
  Scene scene;
  addGround(scene, 8.0);
  // Off the middle, so that no spoke starts along a grid of pixels.
  const glm::dvec3 hub(0.013, settings.height, 0.011);
  const double half = 0.5 * settings.thickness;
  Mesh wheel = frustum(hub - glm::dvec3(0.0, half, 0.0), hub + glm::dvec3(0.0, 0.25, 0.0), 0.06, 0.03, 24);
  for (int i = 0; i < settings.spokes; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.3) / settings.spokes;
    const glm::dvec3 along(std::cos(angle), 0.0, std::sin(angle)), across(-along.z, 0.0, along.x);
    Mesh spoke = box({-0.5, -half, -half}, {0.5, half, half});
    for (glm::dvec3& p : spoke.positions)
      p = hub + (0.55 + p.x) * along + p.z * across + glm::dvec3(0.0, p.y, 0.0);
    append(wheel, spoke);
  }
  addPart(scene, "wheel", wheel, kMoves);
  PartMotion motion = motionOfLast(scene);
  motion.pivot = hub;
  motion.turnDegS = settings.turnDegS;
  motion.travel = {settings.reach, 0.0, 0.0};
  motion.periodS = settings.periodS;
  motion.startS = settings.startS;
  scene.motions = {motion};
  scene.lights = {lightTowards({-1.2, 3.0, 1.0}, {0.0, 0.0, 0.0}, glm::dvec2(0.3))};
  setStillCamera(scene, {{0.4, 2.6, 2.4}, {0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, 36.0});
  return scene;
}

const RegisteredScene<MovingWheelSettings> kMovingWheelRegistered{
    {.name = "moving/wheel",
     .version = 1,
     .summary = "Wheel of thin spokes that turns and shifts over a ground: thin parts under motion",
     .source = "bench"},
    buildMovingWheel};

}  // namespace
}  // namespace limen::scene

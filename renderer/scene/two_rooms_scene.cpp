// SPDX-License-Identifier: BSD-3-Clause
// A closed room with coloured walls, in two halves if it has a dividing wall: light reaches the half that is
// seen round its edge or not at all. Walls face inwards. After the room of Gaitatzes 2012, section 5.6.
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kWidthOfRooms = 4.0, kHeightOfRooms = 3.0, kDepthOfRooms = 6.0;  // m
/// The divider runs into walls, floor and ceiling, so that no ray finds a way between them.
constexpr double kOverlap = 0.05;

struct TwoRoomsSettings {
  double opening = 0.4, thickness = 0.1, albedo = 0.7, emitter = 0.0, glow = 0.0;
  bool lamp = true, coloured = true;
  static const SettingsTable<TwoRoomsSettings>& table() {
    using S = TwoRoomsSettings;
    static const SettingsTable<S> kTable = {
        {&S::opening,
         "opening",
         {0.0, 1.0},
         "",
         "Share of the room's width that the dividing wall leaves open; 0: closed, 1: no wall"},
        {&S::thickness,
         "thickness",
         {0.0, 0.5},
         "m",
         "Of the dividing wall; 0: a single sheet, which both halves see",
         "Gaitatzes 2012, section 5.7 (walls thinner than a voxel)"},
        {&S::albedo, "albedo", {0.0, 0.95}, "", "Reflectance of what is not coloured"},
        {&S::coloured, "coloured", "Left wall red, right wall green"},
        {&S::lamp, "lamp", "A lamp below the ceiling of the far half"},
        {&S::emitter,
         "emitter",
         {0.0, 100.0},
         "",
         "Radiance of a square panel of 1 m below the ceiling of the far half; 0: no panel"},
        {&S::glow, "glow", {0.0, 10.0}, "", "Radiance that all surfaces of the room emit"}};
    return kTable;
  }
};

Scene buildTwoRooms(const TwoRoomsSettings& settings) {
  using V = glm::dvec3;
  Scene scene;
  const auto add = [&](const char* name, const Mesh& mesh, glm::vec3 albedo) {
    Material material;
    material.name = name;
    material.albedo = albedo;
    material.emission = glm::vec3(static_cast<float>(settings.glow));
    addPart(scene, mesh, material);
  };
  const double x = 0.5 * kWidthOfRooms, y = 0.5 * kHeightOfRooms, z = 0.5 * kDepthOfRooms;
  const glm::vec3 plain(static_cast<float>(settings.albedo));
  const glm::vec3 red = settings.coloured ? glm::vec3(0.63F, 0.065F, 0.05F) : plain;
  const glm::vec3 green = settings.coloured ? glm::vec3(0.14F, 0.45F, 0.091F) : plain;
  add("floor", card({0, 0, 0}, {x, 0, 0}, {0, 0, -z}), plain);
  add("ceiling", card({0, kHeightOfRooms, 0}, {x, 0, 0}, {0, 0, z}), plain);
  add("far wall", card({0, y, -z}, {x, 0, 0}, {0, y, 0}), plain);
  add("near wall", card({0, y, z}, {-x, 0, 0}, {0, y, 0}), plain);
  add("left wall", card({-x, y, 0}, {0, 0, -z}, {0, y, 0}), red);
  add("right wall", card({x, y, 0}, {0, 0, z}, {0, y, 0}), green);
  if (settings.opening < 1.0) {
    const double right = x - kWidthOfRooms * settings.opening + (settings.opening == 0.0 ? kOverlap : 0.0);
    const V low(-x - kOverlap, -kOverlap, -0.5 * settings.thickness);
    const V high(right, kHeightOfRooms + kOverlap, 0.5 * settings.thickness);
    const V middle = 0.5 * (low + high), half = 0.5 * (high - low);
    add("divider", settings.thickness > 0.0 ? box(low, high) : card(middle, {half.x, 0, 0}, {0, half.y, 0}),
        plain);
  }
  if (settings.emitter > 0.0) {
    Material panel;
    panel.name = "panel";
    panel.albedo = glm::vec3(0.0F);
    panel.emission = glm::vec3(static_cast<float>(settings.emitter));
    addPart(scene, card({0, kHeightOfRooms - 0.02, -0.5 * z}, {0.5, 0, 0}, {0, 0, 0.5}), panel);
  }
  if (settings.lamp)
    scene.lights = {lightTowards({0, kHeightOfRooms - 0.2, -0.5 * z}, {0, 0, -0.5 * z}, glm::dvec2(0.3))};
  // From a corner of the near half, past the divider's edge.
  setStillCamera(scene, Camera{V(-1.6, 1.7, z - 0.2), V(0.5, 1.3, 0.0), {0.0, 1.0, 0.0}, 62.0});
  return scene;
}

const RegisteredScene<TwoRoomsSettings> kTwoRoomsRegistered{
    {.name = "global_illumination/two_rooms",
     .version = 1,
     .summary = "Closed room with coloured walls and a dividing wall between the lamp and the camera",
     .source = "after Gaitatzes 2012, section 5.6"},
    buildTwoRooms};

}  // namespace
}  // namespace limen::scene

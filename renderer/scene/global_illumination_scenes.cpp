// SPDX-License-Identifier: BSD-3-Clause
// Rooms for indirect light (Gaitatzes 2012, section 5.6 and the cases that its method finds hard): closed on
// all sides, with a coloured wall, divided, with a slanted wall. Their surfaces face inwards.
#include <algorithm>
#include <cmath>
#include <variant>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

Material surfaceOf(const char* name, glm::vec3 albedo, double emission = 0.0) {
  Material material;
  material.name = name;
  material.albedo = albedo;
  material.emission = glm::vec3(static_cast<float>(emission));
  return material;
}

/// An inward-facing rectangle of a room: middle and half extents, in whatever order turns it towards
/// `inside`.
void addInwardWall(Scene& scene, const Material& material, glm::dvec3 middle, glm::dvec3 halfA,
                   glm::dvec3 halfB, glm::dvec3 inside) {
  const bool swap = glm::dot(glm::cross(halfA, halfB), inside - middle) < 0.0;
  addPart(scene, swap ? card(middle, halfB, halfA) : card(middle, halfA, halfB), material,
          Role::ReceiverOnly);
}

struct ClosedBoxSettings {
  double albedo = 0.5, emission = 0.5;
  static const SettingsTable<ClosedBoxSettings>& table() {
    using S = ClosedBoxSettings;
    static const SettingsTable<S> kTable = {
        {&S::albedo, "albedo", {0.0, 0.95}, "", "Of all walls"},
        {&S::emission, "emission", {0.0, 10.0}, "", "Radiance that all walls emit"}};
    return kTable;
  }
};

Scene buildClosedBox(const ClosedBoxSettings& settings) {
  Scene scene;
  Mesh walls = box(glm::dvec3(-1.0), glm::dvec3(1.0));
  for (glm::uvec3& triangle : walls.triangles) std::swap(triangle.y, triangle.z);
  addPart(scene, walls,
          surfaceOf("walls", glm::vec3(static_cast<float>(settings.albedo)), settings.emission));
  setStillCamera(scene, {{0.3, 0.2, 0.8}, {-0.2, -0.1, -1.0}, {0.0, 1.0, 0.0}, 80.0});
  return scene;
}

const RegisteredScene<ClosedBoxSettings> kClosedBoxRegistered{
    {.name = "global_illumination/closed_box",
     .version = 1,
     .summary = "Closed box whose walls all emit the same: radiance emission / (1 - albedo) everywhere",
     .source = "uniform radiosity; the bench's own"},
    buildClosedBox};

struct LampInRoom {
  static constexpr const char *kKind = "lamp", *kSummary = "the lamp below the ceiling";
};
struct PanelInRoom {
  static constexpr const char *kKind = "emitters", *kSummary = "a panel there that emits";
  double emission = 2.0;
  static const SettingsTable<PanelInRoom>& table() {
    using S = PanelInRoom;
    static const SettingsTable<S> kTable = {
        {&S::emission, "emission", {0.0, 10.0}, "", "Radiance of the panel"}};
    return kTable;
  }
};

constexpr double kHalfWidth = 1.5, kHeight = 2.5, kHalfDepth = 1.5;
constexpr glm::vec3 kPlaster{0.7F};

/// Floor, ceiling and back; the front is open, and the camera stands there.
void addShell(Scene& scene, glm::vec3 albedo) {
  const glm::dvec3 inside(0.0, 0.5 * kHeight, 0.0);
  const glm::dvec3 x(kHalfWidth, 0.0, 0.0), y(0.0, 0.5 * kHeight, 0.0), z(0.0, 0.0, kHalfDepth);
  addInwardWall(scene, surfaceOf("floor", albedo), {0.0, 0.0, 0.0}, x, z, inside);
  addInwardWall(scene, surfaceOf("ceiling", albedo), {0.0, kHeight, 0.0}, x, z, inside);
  addInwardWall(scene, surfaceOf("back", albedo), {0.0, 0.5 * kHeight, -kHalfDepth}, x, y, inside);
  setStillCamera(scene, {{0.0, 0.5 * kHeight, 5.2}, {0.0, 0.5 * kHeight, 0.0}, {0.0, 1.0, 0.0}, 40.0});
}

void addSides(Scene& scene, const Material& left, const Material& right) {
  const glm::dvec3 inside(0.0, 0.5 * kHeight, 0.0), y(0.0, 0.5 * kHeight, 0.0), z(0.0, 0.0, kHalfDepth);
  addInwardWall(scene, left, {-kHalfWidth, 0.5 * kHeight, 0.0}, y, z, inside);
  addInwardWall(scene, right, {kHalfWidth, 0.5 * kHeight, 0.0}, y, z, inside);
}

struct ColouredRoomSettings {
  std::variant<LampInRoom, PanelInRoom> lit;
  static const SettingsTable<ColouredRoomSettings>& table() {
    using S = ColouredRoomSettings;
    static const SettingsTable<S> kTable = {{&S::lit, "lit_by", "What lights the room"}};
    return kTable;
  }
};

Scene buildColouredRoom(const ColouredRoomSettings& settings) {
  Scene scene;
  addShell(scene, kPlaster);
  addSides(scene, surfaceOf("left", {0.7F, 0.1F, 0.1F}), surfaceOf("right", kPlaster));
  addPart(scene, "block", box({0.1, 0.0, -0.9}, {0.8, 1.1, -0.2}), kPlaster);
  addPart(scene, "low block", box({-0.9, 0.0, -0.1}, {-0.2, 0.5, 0.6}), kPlaster);
  if (const auto* panel = std::get_if<PanelInRoom>(&settings.lit))
    addPart(scene, card({0.0, kHeight - 0.05, 0.0}, {0.5, 0.0, 0.0}, {0.0, 0.0, 0.5}),
            surfaceOf("panel", glm::vec3(0.0F), panel->emission));
  else
    scene.lights = {lightTowards({0.3, kHeight - 0.2, 0.3}, {0.3, 0.0, 0.3}, glm::dvec2(0.3))};
  return scene;
}

const RegisteredScene<ColouredRoomSettings> kColouredRoomRegistered{
    {.name = "global_illumination/room",
     .version = 1,
     .summary = "Room with a red wall and two blocks, open in front, lit by a lamp or by an emitting panel",
     .source = "stand-in for the room of Gaitatzes 2012, section 5.6"},
    buildColouredRoom};

struct DividedRoomSettings {
  double transmittance = 0.0, albedo = 0.5, emission = 1.0;
  static const SettingsTable<DividedRoomSettings>& table() {
    using S = DividedRoomSettings;
    static const SettingsTable<S> kTable = {
        {&S::transmittance, "transmittance", {0.0, 1.0}, "", "Share of the light that passes the wall"},
        {&S::albedo, "albedo", {0.0, 0.95}, "", "Of the room's surfaces; the dividing wall is black"},
        {&S::emission, "emission", {0.0, 10.0}, "", "Radiance of the left wall"}};
    return kTable;
  }
};

Scene buildDividedRoom(const DividedRoomSettings& settings) {
  Scene scene;
  const glm::vec3 albedo(static_cast<float>(settings.albedo));
  addShell(scene, albedo);
  addSides(scene, surfaceOf("left", albedo, settings.emission), surfaceOf("right", albedo));
  // It reaches to the open front, from where nothing comes back.
  Material divider = surfaceOf("divider", glm::vec3(0.0F));
  divider.transmittance = glm::vec3(static_cast<float>(settings.transmittance));
  divider.refractiveIndex = 1.0F;
  addPart(scene, card({0.0, 0.5 * kHeight, 0.0}, {0.0, 0.5 * kHeight, 0.0}, {0.0, 0.0, kHalfDepth}), divider);
  return scene;
}

const RegisteredScene<DividedRoomSettings> kDividedRoomRegistered{
    {.name = "global_illumination/divided_room",
     .version = 1,
     .summary = "Two rooms, open in front, with a thin wall between: the left wall of one emits, and a share "
                "passes",
     .source = "Gaitatzes 2012, sections 5.5.2 and 5.7; the bench's own"},
    buildDividedRoom};

struct SlantedWallSettings {
  double angleDeg = 45.0, emission = 1.0;
  static const SettingsTable<SlantedWallSettings>& table() {
    using S = SlantedWallSettings;
    static const SettingsTable<S> kTable = {
        {&S::angleDeg, "angle_deg", {0.0, 90.0}, "deg", "Between the white wall and the floor"},
        {&S::emission, "emission", {0.0, 10.0}, "", "Radiance of the left wall"}};
    return kTable;
  }
};

Scene buildSlantedWall(const SlantedWallSettings& settings) {
  Scene scene;
  addShell(scene, glm::vec3(0.3F));
  addSides(scene, surfaceOf("left", glm::vec3(0.0F), settings.emission), surfaceOf("right", glm::vec3(0.0F)));
  const double angle = glm::radians(settings.angleDeg);
  addPart(scene,
          card({0.6, 0.5 * kHeight, 0.0}, {0.8 * std::cos(angle), 0.8 * std::sin(angle), 0.0},
               {0.0, 0.0, -0.8 * kHalfDepth}),
          surfaceOf("slanted", glm::vec3(0.9F)));
  return scene;
}

const RegisteredScene<SlantedWallSettings> kSlantedWallRegistered{
    {.name = "global_illumination/slanted_wall",
     .version = 1,
     .summary = "White wall at an angle to the floor, lit by an emitting wall, in a dim room",
     .source = "Gaitatzes 2012, section 5.5.2; the bench's own"},
    buildSlantedWall};

}  // namespace
}  // namespace limen::scene

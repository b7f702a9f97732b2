// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/base/error.h"
#include "experiments/base/text.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kHeightOfLight = 3.2;

struct BoxSettings {
  double boxHeight = 1.0, clearance = 0.0;
  bool sides = true;
  static const SettingsTable<BoxSettings>& table() {
    using S = BoxSettings;
    static const SettingsTable<S> kTable = {
        {&S::boxHeight, "box_height", {0.05, 2.0}, "m", "Height of the box; the light is at 3.2 m"},
        {&S::clearance, "clearance", {0.0, 2.0}, "m", "Height of the box's underside above the ground"},
        {&S::sides, "sides",
         "Include the box's sides; without them the top and the underside are left as two flat blockers"}};
    return kTable;
  }
  void check() const {
    const double top = clearance + boxHeight;
    if (top >= kHeightOfLight)
      throw Error("the box reaches up to " + shortestNumber(top) + " m, and the light is at " +
                      shortestNumber(kHeightOfLight) + " m",
                  "box_height", "lower 'box_height' or 'clearance'");
  }
};

/// The light is wider than the box and straight above it: from the light's centre only the box's top is seen,
/// from its rim the sides shadow more. A single shadow map from the centre misses that and, if the box
/// hovers, the umbra below.
Scene buildBoxUnderLight(const BoxSettings& settings) {
  const double foot = settings.clearance, top = foot + settings.boxHeight;
  Scene scene;
  addGround(scene, 12.0);
  Mesh caster = box({-0.5, foot, -0.5}, {0.5, top, 0.5});
  if (!settings.sides)
    std::erase_if(caster.triangles, [&](const glm::uvec3& t) {
      return caster.positions[t.x].y != caster.positions[t.y].y ||
             caster.positions[t.x].y != caster.positions[t.z].y;
    });
  addPart(scene, "box", caster, {0.7F, 0.5F, 0.35F});
  scene.lights = {lightTowards({0.0, kHeightOfLight, 0.0}, glm::dvec3(0.0), {2.0, 2.0})};
  setStillCamera(scene, orbitCamera({0.0, 0.3, 0.0}, 5.2, 25.0, 40.0));
  return scene;
}

struct TwoBoxesSettings {
  double gap = 0.3;
  static const SettingsTable<TwoBoxesSettings>& table() {
    static const SettingsTable<TwoBoxesSettings> kTable = {
        {&TwoBoxesSettings::gap, "gap", {0.0, 0.6}, "m", "Clear height between the boxes; 0: they touch"}};
    return kTable;
  }
};

/// A small high box partly above a low wide one: their penumbrae meet on the ground and the upper one's falls
/// on the lower box.
Scene buildTwoBoxes(const TwoBoxesSettings& settings) {
  const double gap = settings.gap;
  Scene scene;
  addGround(scene, 9.0);
  addPart(scene, "low_box", box({-0.7, 0.0, -0.4}, {0.5, 0.4, 0.5}), {0.45F, 0.55F, 0.7F});
  addPart(scene, "high_box", box({-0.1, 0.4 + gap, -0.3}, {0.7, 0.6 + gap, 0.3}), {0.75F, 0.55F, 0.3F});
  frameStanding(scene, 1.0, 1.0);
  return scene;
}

struct PoleSettings {
  double radius = 0.04;
  static const SettingsTable<PoleSettings>& table() {
    static const SettingsTable<PoleSettings> kTable = {
        {&PoleSettings::radius, "radius", {0.002, 0.2}, "m", "Radius of the pole at its foot"}};
    return kTable;
  }
};

/// The shadow is sharp at the foot and soft at its end.
Scene buildPole(const PoleSettings& settings) {
  const double radius = settings.radius;
  Scene scene;
  addGround(scene, 10.0);
  Mesh pole = frustum({0.0, 0.0, 0.0}, {0.0, 1.9, 0.0}, radius, 0.7 * radius, 24);
  append(pole, frustum({0.0, 1.88, 0.0}, {0.5, 1.96, 0.0}, 0.6 * radius, 0.6 * radius, 24));
  append(pole, box({0.42, 1.9, -0.07}, {0.72, 1.96, 0.07}));
  addPart(scene, "pole", pole, {0.4F, 0.4F, 0.42F});
  scene.lights = {lightTowards({-3.2, 4.2, 2.4}, {0.3, 0.6, 0.0}, {0.3, 0.3})};
  setStillCamera(scene, orbitCamera({0.6, 0.6, -0.3}, 4.6, 12.0, 44.0));
  return scene;
}

const RegisteredScene<BoxSettings> kBoxUnderLight{
    {.name = "box_under_light",
     .version = 1,
     .summary = "Box below a larger light: a shadow map from the centre sees only its top",
     .source = "Schwarz 2009, Fig. 4.3"},
    buildBoxUnderLight};

const RegisteredScene<TwoBoxesSettings> kTwoBoxes{
    {.name = "two_boxes",
     .version = 1,
     .summary = "A floating box above a standing one: fused penumbrae and a shadow on an occluder",
     .source = "bench"},
    buildTwoBoxes};

const RegisteredScene<PoleSettings> kPole{
    {.name = "pole",
     .version = 1,
     .summary = "Street lamp: one thin shadow from contact to far penumbra",
     .source = "Schwarz 2009, Fig. 3.2"},
    buildPole};

}  // namespace
}  // namespace limen::scene

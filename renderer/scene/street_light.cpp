// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/scene/tree.h"

namespace limen::scene {
namespace {

struct StreetLightSettings {
  double poleRadius = 0.03, trunkRadius = 0.035;
  int branching = 4;
  int64_t seed = 3;
  static const SettingsTable<StreetLightSettings>& table() {
    using S = StreetLightSettings;
    static const SettingsTable<S> kTable = {
        {&S::poleRadius, "pole_radius", {0.002, 0.1}, "m", "Radius of the pole at its foot"},
        {&S::trunkRadius,
         "trunk_radius",
         {0.002, 0.1},
         "m",
         "Radius of the tree's foot; each branching halves it"},
        {&S::branching,
         "branching",
         {0, 5},
         "",
         "Branching levels of the tree, 6 twigs each; 20 triangles per twig"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the tree"}};
    return kTable;
  }
};

/// A lamp post and, behind it, a bare tree whose crown is partly outside the picture while its shadow is
/// inside.
Scene buildStreetLight(const StreetLightSettings& settings) {
  const double radius = settings.poleRadius;
  Mesh pole = frustum({-0.55, 0.0, 0.25}, {-0.55, 1.7, 0.25}, radius, 0.7 * radius, 24);
  append(pole, frustum({-0.55, 1.68, 0.25}, {-0.1, 1.76, 0.25}, 0.6 * radius, 0.6 * radius, 24));
  append(pole, box({-0.2, 1.7, 0.18}, {0.08, 1.75, 0.32}));
  Tree tree(settings.seed);
  tree.grow({0.35, 0.0, -0.6}, {0.0, 1.0, 0.0}, 1.0, settings.trunkRadius, settings.branching);
  Scene scene;
  addGround(scene, 12.0);
  addPart(scene, "pole", pole, {0.4F, 0.4F, 0.42F});
  addPart(scene, "wood", tree.wood(), {0.35F, 0.26F, 0.2F});
  scene.lights = {lightTowards({-3.4, 4.6, -1.6}, {0.2, 0.5, 0.0}, {0.3, 0.3})};
  setStillCamera(scene, orbitCamera({0.35, 0.35, 0.1}, 4.6, 6.0, 34.0));
  return scene;
}

const RegisteredScene<StreetLightSettings> kStreetLightRegistered{
    {.name = "street_light",
     .version = 1,
     .summary = "Lamp post and bare tree: shadows that harden on contact, twigs thinner than a pixel",
     .source = "Schwarz 2009, Fig. 3.2"},
    buildStreetLight};

}  // namespace
}  // namespace limen::scene

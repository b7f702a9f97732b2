// SPDX-License-Identifier: BSD-3-Clause
// Mirrors of different kinds in one scene, each of which calls for a technique of its own (Roger 2008,
// section 6).
#include <algorithm>
#include "renderer/scene/mirrors/mirror_parts.h"

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct SeveralMirrorsSettings {
  int tessellation = 32;
  double reflectance = 0.8, glossRad = 0.0;
  ObjectMotion motion;
  static const SettingsTable<SeveralMirrorsSettings>& table() {
    using S = SeveralMirrorsSettings;
    static const SettingsTable<S> kTable = {
        {&S::tessellation,
         "tessellation",
         {4, 96},
         "segments",
         "Segments in a quarter of the egg's sections; a fourth of it in those of the figure's limbs"},
        {&S::reflectance, "reflectance", {0.0, 1.0}, "", "Share of the light that the mirrors reflect"},
        {&S::glossRad, "gloss", {0.0, 1.0}, "rad", "Half-angle of the cone from which the egg gathers light"},
        {&S::motion, "motion", kMotionText}};
    return kTable;
  }
};

Scene buildSeveralMirrors(const SeveralMirrorsSettings& settings) {
  Scene scene;
  addCheckeredGround(scene, 8.0, 0.5);
  const auto mirror = [&](const char* name, double glossRad) {
    Material material = mirrorMaterial(settings.reflectance, glossRad);
    material.name = name;
    return material;
  };
  addPart(scene, card({0.0, 0.8, -1.3}, {1.3, 0.0, 0.0}, {0.0, 0.75, 0.0}), mirror("pane", 0.0));
  addPart(scene, ellipsoid({-0.75, 0.45, 0.1}, {0.4, 0.45, 0.35}, settings.tessellation),
          mirror("egg", settings.glossRad));
  addPart(scene, movedMesh(statue(std::max(settings.tessellation / 4, 1)), 1.0, 20.0, {0.75, 0.0, 0.1}),
          mirror("figure", 0.0));
  addPart(scene, "box", box({-0.15, 0.0, 0.35}, {0.2, 0.35, 0.7}), {0.7F, 0.25F, 0.2F});
  moveLastPart(scene, settings.motion, {.pivot = {0.025, 0.0, 0.525}, .turnDegS = 90.0});
  addPart(scene, "ball", sphere({0.0, 0.3, -0.6}, 0.25, 24), {0.25F, 0.5F, 0.7F});
  moveLastPart(scene, settings.motion, {.travel = {0.25, 0.0, 0.0}, .periodS = 2.0});
  addPart(scene, "cone", frustum({1.5, 0.0, 0.9}, {1.5, 0.7, 0.9}, 0.25, 0.0, 48), {0.3F, 0.6F, 0.3F});
  moveLastPart(scene, settings.motion, {.travel = {0.0, 0.0, 0.3}, .periodS = 3.0});
  scene.lights = {lightTowards({-2.0, 4.0, 2.5}, {0.0, 0.4, 0.0}, glm::dvec2(0.3))};
  setStillCamera(scene, {{0.5, 1.45, 3.1}, {0.0, 0.5, -0.3}, {0.0, 1.0, 0.0}, 42.0});
  return scene;
}

const RegisteredScene<SeveralMirrorsSettings> kSeveralMirrors{
    {.name = "mirrors/several",
     .version = 1,
     .summary = "A plane, a smooth convex and an irregular mirror among objects: pane, egg and figure",
     .source = "bench; for Roger 2008, section 6"},
    buildSeveralMirrors};

}  // namespace
}  // namespace limen::scene

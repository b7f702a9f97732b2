// SPDX-License-Identifier: BSD-3-Clause
// Planar mirrors: one to three that face one another, and a box of them around a statue (Roger 2008,
// sections 2.2.1 and 3.5).
#include "renderer/scene/mirrors/mirror_parts.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct MirrorPlanesSettings {
  int planes = 2;
  double angleDeg = 4.0, reflectance = 0.8;
  static const SettingsTable<MirrorPlanesSettings>& table() {
    using S = MirrorPlanesSettings;
    static const SettingsTable<S> kTable = {
        {&S::planes, "planes", {1, 3}, "", "Mirrors: behind, then in front, then a part of the floor"},
        {&S::angleDeg, "angle", {0.0, 30.0}, "deg", "Turn of the mirror behind about the vertical axis"},
        {&S::reflectance, "reflectance", {0.0, 1.0}, "", "Share of the light that the mirrors reflect"}};
    return kTable;
  }
};

Scene buildMirrorPlanes(const MirrorPlanesSettings& settings) {
  Scene scene;
  addCheckeredGround(scene, 8.0, 0.5);
  const Material material = mirrorMaterial(settings.reflectance);
  const double turn = glm::radians(settings.angleDeg);
  // Each is one rectangle: all of its triangles lie in one plane.
  addPart(
      scene,
      card({0.0, 0.8, -1.2}, glm::dvec3(1.2 * std::cos(turn), 0.0, -1.2 * std::sin(turn)), {0.0, 0.75, 0.0}),
      material);
  if (settings.planes >= 2)
    addPart(scene, card({0.0, 0.5, 1.4}, {-1.1, 0.0, 0.0}, {0.0, 0.45, 0.0}), material);
  if (settings.planes >= 3)
    addPart(scene, card({0.0, 0.02, 0.1}, {0.9, 0.0, 0.0}, {0.0, 0.0, -0.7}), material);
  addPart(scene, "box", box({-0.7, 0.05, -0.5}, {-0.3, 0.55, -0.1}), {0.7F, 0.25F, 0.2F});
  addPart(scene, "ball", sphere({0.45, 0.35, 0.0}, 0.3, 24), {0.25F, 0.5F, 0.7F});
  // In contact with the mirror behind where that does not turn.
  addPart(scene, "post", frustum({0.9, 0.0, -1.0}, {0.9, 0.7, -1.0}, 0.08, 0.08, 24), {0.3F, 0.6F, 0.3F});
  scene.lights = {lightTowards({-2.0, 4.0, 2.5}, {0.0, 0.4, 0.0}, glm::dvec2(0.3))};
  setStillCamera(scene, {{0.7, 1.5, 3.2}, {0.0, 0.55, -0.6}, {0.0, 1.0, 0.0}, 42.0});
  return scene;
}

const RegisteredScene<MirrorPlanesSettings> kMirrorPlanes{
    {.name = "mirrors/planes",
     .version = 1,
     .summary = "One to three planar mirrors that face one another around a few objects",
     .source = "bench; for Roger 2008, sections 1.3.1 and 2.1.1"},
    buildMirrorPlanes};

struct MirrorBoxSettings {
  int tessellation = 20;
  double reflectance = 0.8;
  static const SettingsTable<MirrorBoxSettings>& table() {
    using S = MirrorBoxSettings;
    static const SettingsTable<S> kTable = {
        {&S::tessellation,
         "tessellation",
         {1, 96},
         "segments",
         "Segments in a quarter circle of the statue's nine limbs; 20: 28,800 triangles",
         "Roger 2008, Fig. 3.10 (30 K triangles)"},
        {&S::reflectance, "reflectance", {0.0, 1.0}, "", "Share of the light that the walls reflect"}};
    return kTable;
  }
};

/// Walls of mirrors on four sides, open above; the camera looks over the front wall.
Scene buildMirrorBox(const MirrorBoxSettings& settings) {
  Scene scene;
  addCheckeredGround(scene, 2.0, 0.25);
  const Material wall = mirrorMaterial(settings.reflectance);
  addPart(scene, card({0.0, 0.6, -1.0}, {1.0, 0.0, 0.0}, {0.0, 0.6, 0.0}), wall);
  addPart(scene, card({-1.0, 0.6, 0.0}, {0.0, 0.0, -1.0}, {0.0, 0.6, 0.0}), wall);
  addPart(scene, card({1.0, 0.6, 0.0}, {0.0, 0.0, 1.0}, {0.0, 0.6, 0.0}), wall);
  addPart(scene, card({0.0, 0.15, 1.0}, {-1.0, 0.0, 0.0}, {0.0, 0.15, 0.0}), wall);
  Material stone;
  stone.name = "statue";
  stone.albedo = glm::vec3(0.75F, 0.7F, 0.6F);
  addPart(scene, movedMesh(statue(settings.tessellation), 0.9, 20.0, {0.0, 0.15, -0.1}), stone);
  addPart(scene, "pedestal", box({-0.3, 0.0, -0.35}, {0.3, 0.15, 0.25}), {0.35F, 0.4F, 0.45F});
  scene.lights = {lightTowards({0.6, 4.0, 1.5}, {0.0, 0.5, 0.0}, glm::dvec2(0.3))};
  setStillCamera(scene, {{0.35, 1.1, 2.6}, {0.0, 0.5, -0.2}, {0.0, 1.0, 0.0}, 40.0});
  return scene;
}

const RegisteredScene<MirrorBoxSettings> kMirrorBox{
    {.name = "mirrors/box",
     .version = 1,
     .summary = "Statue between walls of mirrors: reflections of reflections of reflections",
     .source = "stand-in for Roger 2008, Figs. 3.10 and 5.11"},
    buildMirrorBox};

}  // namespace
}  // namespace limen::scene

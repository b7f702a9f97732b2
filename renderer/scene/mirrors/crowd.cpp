// SPDX-License-Identifier: BSD-3-Clause
// Many reflecting and refracting objects that all see each other (Holländer 2013, section 3.6.3).
#include <algorithm>
#include <cmath>

#include "renderer/scene/import.h"
#include "renderer/scene/mirrors/mirror_parts.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct MirrorCrowdSettings {
  int objects = 27, tessellation = 8, glassOf = 3;
  double reflectance = 0.8;
  int64_t seed = 1;
  static const SettingsTable<MirrorCrowdSettings>& table() {
    using S = MirrorCrowdSettings;
    static const SettingsTable<S> kTable = {
        {&S::objects, "objects", {1, 1000}, "", "Objects", "Holländer 2013, section 3.6.3 (400)"},
        {&S::tessellation,
         "tessellation",
         {1, 48},
         "segments",
         "Segments in a quarter circle; 25: 5,000 triangles an object, two million of 400",
         "Holländer 2013, section 3.6.3 (2 M triangles)"},
        {&S::glassOf, "glass_every", {0, 16}, "", "Every so many objects, one is of glass; 0: none"},
        {&S::reflectance,
         "reflectance",
         {0.0, 1.0},
         "",
         "Share of the light that they reflect, or let through"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of their places and sizes"}};
    return kTable;
  }
};

/// Ellipsoids on a loose lattice, 1 apart, in a room that is open to the front.
Scene buildMirrorCrowd(const MirrorCrowdSettings& settings) {
  Scene scene;
  const int aside = static_cast<int>(std::ceil(std::cbrt(double(settings.objects)) - 1e-9));
  const double half = 0.5 * aside + 0.5, height = 2.0 * half;
  addCheckeredGround(scene, 2.0 * half, 0.5);
  addPart(scene, "back", card({0.0, half, -half}, {half, 0.0, 0.0}, {0.0, half, 0.0}), {0.7F, 0.7F, 0.68F});
  addPart(scene, "left", card({-half, half, 0.0}, {0.0, 0.0, -half}, {0.0, half, 0.0}), {0.65F, 0.2F, 0.15F});
  addPart(scene, "right", card({half, half, 0.0}, {0.0, 0.0, half}, {0.0, half, 0.0}), {0.2F, 0.5F, 0.2F});
  Material mirror = mirrorMaterial(settings.reflectance), glass;
  glass.name = "glass";
  glass.albedo = glm::vec3(0.02F);
  glass.transmittance = glm::vec3(static_cast<float>(settings.reflectance));
  Random random(settings.seed);
  for (int i = 0; i < settings.objects; ++i) {
    const auto place = [&](int cell) { return cell - 0.5 * (aside - 1) + random.uniform(-0.1, 0.1); };
    const double x = place(i % aside), z = place(i / aside % aside), y = place(i / (aside * aside)) + half;
    const glm::dvec3 axes(random.uniform(0.2, 0.38), random.uniform(0.2, 0.38), random.uniform(0.2, 0.38));
    addPart(scene, ellipsoid({x, y, z}, axes, settings.tessellation),
            settings.glassOf > 0 && i % settings.glassOf == settings.glassOf - 1 ? glass : mirror);
  }
  scene.lights = {
      lightTowards({-0.5 * half, 1.2 * height, 2.0 * half}, {0.0, half, 0.0}, glm::dvec2(0.1 * half))};
  setStillCamera(scene, {{0.0, 1.1 * half, 3.5 * half}, {0.0, half, 0.0}, {0.0, 1.0, 0.0}, 40.0});
  return scene;
}

const RegisteredScene<MirrorCrowdSettings> kMirrorCrowd{
    {.name = "mirrors/crowd",
     .version = 1,
     .summary = "Mirroring and glass ellipsoids that all see each other, in a room open to the front",
     .source = "stand-in for Holländer 2013, Fig. 3.19 (400 objects in a Cornell box)"},
    buildMirrorCrowd};

}  // namespace
}  // namespace limen::scene

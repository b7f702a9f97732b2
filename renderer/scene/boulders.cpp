// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "renderer/scene/bumps.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kBoulderPitch = 0.5;

struct BouldersSettings {
  int boulders = 24, tessellation = 36;
  double bumps = 0.35;
  int64_t seed = 1;
  static const SettingsTable<BouldersSettings>& table() {
    using S = BouldersSettings;
    static const SettingsTable<S> kTable = {
        {&S::boulders, "boulders", {1, 100}, "boulders", "Number of lumps"},
        {&S::tessellation,
         "tessellation",
         {1, 64},
         "segments",
         "Segments in a quarter circle; a lump has 8 times its square triangles: 250,880 with the ground's "
         "at "
         "the defaults"},
        {&S::bumps, "bumps", {0.0, 0.8}, "", "Height of the bumps relative to the mean radius"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the bumps"}};
    return kTable;
  }
};

/// Rows of finely tessellated lumps that touch neither each other nor the ground.
Scene buildBoulders(const BouldersSettings& settings) {
  const int count = settings.boulders, cells = settings.tessellation;
  const int columns = static_cast<int>(std::ceil(std::sqrt(1.5 * count))),
            rows = (count + columns - 1) / columns;
  const double reach = 0.5 * kBoulderPitch * columns;
  const double amplitude = settings.bumps;
  // A lump reaches just less than halfway to its neighbour.
  const double radius = 0.45 * kBoulderPitch / (1.0 + amplitude);
  const Mesh unit = sphere(glm::dvec3(0.0), 1.0, cells);
  Mesh boulders;
  boulders.positions.reserve(unit.positions.size() * static_cast<size_t>(count));
  boulders.triangles.reserve(unit.triangles.size() * static_cast<size_t>(count));
  for (int i = 0; i < count; ++i) {
    const Bumps bumps(radius, amplitude, settings.seed + i);
    const glm::dvec3 centre(kBoulderPitch * (i % columns - 0.5 * (columns - 1)), 0.5 * kBoulderPitch,
                            kBoulderPitch * (i / columns - 0.5 * (rows - 1)));
    Mesh boulder = unit;
    for (glm::dvec3& position : boulder.positions) position = centre + bumps.radius(position) * position;
    append(boulders, boulder);
  }
  Scene scene;
  addGround(scene, 9.0 * reach);
  addPart(scene, "boulders", boulders, {0.6F, 0.57F, 0.52F});
  frameStanding(scene, kBoulderPitch, reach);
  scene.lights[0].size = glm::dvec2(0.2 * reach);
  return scene;
}

const RegisteredScene<BouldersSettings> kBouldersRegistered{
    {.name = "boulders",
     .version = 1,
     .summary = "Field of finely tessellated lumps, a quarter of a million triangles: heavy geometry",
     .source = "bench (what Schwarz 2009, section 4.6, calls highly tessellated)"},
    buildBoulders};

}  // namespace
}  // namespace limen::scene

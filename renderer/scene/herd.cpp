// SPDX-License-Identifier: BSD-3-Clause
// A herd that moves: stand-in for the animated characters of Holländer 2013, section 3.6.2 (Dosch, Grog,
// Dragon), whose meshes are not to be had, with as many triangles.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "renderer/scene/mirrors/mirror_parts.h"
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kAnimalPitch = 0.9;

struct MovingHerdSettings {
  int animals = 64, tessellation = 4, groups = 8;
  ObjectMotion motion;
  int64_t seed = 1;
  static const SettingsTable<MovingHerdSettings>& table() {
    using S = MovingHerdSettings;
    static const SettingsTable<S> kTable = {
        {&S::animals, "animals", {1, 1024}, "", "Number of figures"},
        {&S::tessellation,
         "tessellation",
         {1, 24},
         "segments",
         "Segments in a quarter circle of each of nine limbs: 72 times its square triangles a figure",
         "Holländer 2013, tables 3.1 and 3.2 (500,000 to 4 million triangles: 900 figures at 3 to 8)"},
        {&S::groups, "groups", {1, 64}, "", "Groups that move each as one"},
        {&S::motion, "motion", kMotionText},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of places, sizes and motions"}};
    return kTable;
  }
};

/// Rows of figures on a ground that only receives; each group walks to and fro and turns.
Scene buildMovingHerd(const MovingHerdSettings& settings) {
  Scene scene;
  const int aside = static_cast<int>(std::ceil(std::sqrt(double(settings.animals))));
  const int groups = std::min(settings.groups, settings.animals);
  const double extent = kAnimalPitch * aside;
  const double reach = 0.6 * extent + 2.5;
  addGround(scene, 2.6 * reach);
  const Mesh figure = statue(settings.tessellation);
  Random random(settings.seed);
  std::vector<Mesh> herds(static_cast<size_t>(groups));
  for (int i = 0; i < settings.animals; ++i) {
    const double x = (i % aside + random.uniform(0.2, 0.8)) * kAnimalPitch - 0.5 * extent,
                 z = (i / aside + random.uniform(0.2, 0.8)) * kAnimalPitch - 0.5 * extent;
    append(herds[static_cast<size_t>(i % groups)],
           movedMesh(figure, random.uniform(0.7, 1.1), random.uniform(0.0, 360.0), {x, 0.0, z}));
  }
  for (int group = 0; group < groups; ++group) {
    const float shade = static_cast<float>(random.uniform(0.4, 0.8));
    addPart(scene, "herd_" + std::to_string(group), herds[static_cast<size_t>(group)],
            {shade, 0.75F * shade, 0.5F * shade});
    const double towards = random.uniform(0.0, 6.283185307179586);
    moveLastPart(scene, settings.motion,
                 {.turnDegS = random.uniform(-6.0, 6.0),
                  .travel = 0.6 * glm::dvec3(std::cos(towards), 0.0, std::sin(towards)),
                  .periodS = random.uniform(2.0, 5.0)});
  }
  scene.lights = {lightTowards({-1.2 * extent - 1.0, 0.8 * extent + 2.5, 1.1 * extent}, glm::dvec3(0.0),
                               glm::dvec2(0.2 * extent + 0.4))};
  // From above, so that the ground fills the picture.
  setMovingCamera(scene, {{0.0, 1.6 * reach, 0.8 * reach}, {0.0, 0.3, 0.0}, {0.0, 1.0, 0.0}, 40.0},
                  {{0.6 * reach, 1.4 * reach, 0.5 * reach}, {0.0, 0.3, 0.0}, {0.0, 1.0, 0.0}, 40.0}, 4.0);
  return scene;
}

const RegisteredScene<MovingHerdSettings> kMovingHerd{
    {.name = "herd",
     .version = 1,
     .summary = "Figures that walk to and fro in groups, up to 4 million triangles: geometry that moves",
     .source = "stand-in for Holländer 2013, tables 3.1 and 3.2"},
    buildMovingHerd};

}  // namespace
}  // namespace limen::scene

// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "renderer/scene/bumps.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

constexpr double kCornerSide = 2.0;

struct TessellatedCornerSettings {
  int lumps = 1, tessellation = 40, vertices = 33;
  double bumps = 0.35;
  int64_t seed = 1;
  static const SettingsTable<TessellatedCornerSettings>& table() {
    using S = TessellatedCornerSettings;
    static const SettingsTable<S> kTable = {
        {&S::lumps, "lumps", {1, 9}, "lumps", "Number of lumps in the corner"},
        {&S::tessellation,
         "tessellation",
         {1, 400},
         "segments",
         "Segments in a quarter circle; a lump has 8 times its square triangles"},
        {&S::vertices,
         "vertices",
         {2, 256},
         "",
         "Vertices along each edge of the floor and of each wall: 3 times its square receive occlusion",
         "Gaitatzes 2012, section 4.6.1 (33)"},
        {&S::bumps, "bumps", {0.0, 0.8}, "", "Height of the bumps relative to the mean radius"},
        {&S::seed, "seed", {0, 1000000}, "", "Seed of the bumps"}};
    return kTable;
  }
};

/// Lumps in equal cells of the corner, apart from each other, floor and walls.
Mesh lumpsInCorner(const TessellatedCornerSettings& settings) {
  const int columns = static_cast<int>(std::ceil(std::sqrt(double(settings.lumps))));
  // One alone fills half of the corner, so that floor and walls see it well.
  const double cell = 0.5 * kCornerSide / std::max(0.5 * columns, 1.0);
  const double radius = 0.45 * cell / (1.0 + settings.bumps);
  const Mesh unit = sphere(glm::dvec3(0.0), 1.0, settings.tessellation);
  Mesh lumps;
  for (int i = 0; i < settings.lumps; ++i) {
    const Bumps bumps(radius, settings.bumps, settings.seed + i);
    const glm::dvec3 centre =
        columns == 1 ? glm::dvec3(0.6 * cell)
                     : glm::dvec3((i % columns + 0.5) * cell, 0.5 * cell, (i / columns + 0.5) * cell);
    Mesh lump = unit;
    for (glm::dvec3& position : lump.positions) position = centre + bumps.radius(position) * position;
    append(lumps, lump);
  }
  return lumps;
}

Scene buildTessellatedCorner(const TessellatedCornerSettings& settings) {
  constexpr double kHalf = 0.5 * kCornerSide, kLightSide = 0.5;
  const int cells = settings.vertices - 1;
  const glm::dvec3 x(kHalf, 0.0, 0.0), y(0.0, kHalf, 0.0), z(0.0, 0.0, kHalf);
  Scene scene;
  addPart(scene, "floor", cardGrid(x + z, z, x, cells), {0.6F, 0.6F, 0.58F}, Role::ReceiverOnly);
  addPart(scene, "left_wall", cardGrid(y + z, y, z, cells), {0.6F, 0.58F, 0.55F}, Role::ReceiverOnly);
  addPart(scene, "back_wall", cardGrid(x + y, x, y, cells), {0.55F, 0.58F, 0.6F}, Role::ReceiverOnly);
  addPart(scene, "lumps", lumpsInCorner(settings), {0.7F, 0.62F, 0.5F});
  const glm::dvec3 middle(0.25 * kCornerSide);
  scene.lights = {lightTowards({2.2, 5.0, 4.5}, middle, glm::dvec2(kLightSide))};
  // Floor and walls fill the picture.
  setStillCamera(scene, orbitCamera(middle, 2.6, 45.0, 32.0));
  return scene;
}

const RegisteredScene<TessellatedCornerSettings> kTessellatedCorner{
    {.name = "tessellated_corner",
     .version = 1,
     .summary = "Corner of a room in a grid of vertices, with lumps of any number of triangles",
     .source = "stand-in for Gaitatzes 2012, section 4.6.1 and Fig. 34"},
    buildTessellatedCorner};

}  // namespace
}  // namespace limen::scene

// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct SphereGridSettings {
  int spheresPerAxis = 3, tessellation = 16;
  static const SettingsTable<SphereGridSettings>& table() {
    using S = SphereGridSettings;
    static const SettingsTable<S> kTable = {
        {&S::spheresPerAxis,
         "spheres_per_axis",
         {1, 6},
         "spheres",
         "Spheres along each edge of the cube",
         "Schwarz 2009, Fig. 4.33"},
        {&S::tessellation,
         "tessellation",
         {1, 48},
         "segments",
         "Segments in a quarter circle; a sphere has 8 times its square triangles"}};
    return kTable;
  }
};

/// Grid of spheres in a cube of side 1.6 whose lowest point floats above the ground: every shadow ray can
/// meet several spheres one behind another, and every sphere is a receiver too.
Scene buildSphereGrid(const SphereGridSettings& settings) {
  const int perAxis = settings.spheresPerAxis, cells = settings.tessellation;
  constexpr double kSide = 1.6, kLowest = 0.15;
  const double pitch = kSide / perAxis, radius = 0.36 * pitch;
  Mesh spheres;
  for (int y = 0; y < perAxis; ++y)
    for (int z = 0; z < perAxis; ++z)
      for (int x = 0; x < perAxis; ++x) {
        const glm::dvec3 cell((x + 0.5) * pitch - 0.5 * kSide, kLowest + radius + y * pitch,
                              (z + 0.5) * pitch - 0.5 * kSide);
        append(spheres, sphere(cell, radius, cells));
      }
  Scene scene;
  addGround(scene, 16.0);
  addPart(scene, "spheres", spheres, {0.7F, 0.62F, 0.5F});
  frameStanding(scene, kSide + kLowest, 1.2);
  return scene;
}

struct TwoColourSettings {
  int tessellation = 16;
  static const SettingsTable<TwoColourSettings>& table() {
    static const SettingsTable<TwoColourSettings> kTable = {{&TwoColourSettings::tessellation,
                                                             "tessellation",
                                                             {1, 48},
                                                             "segments",
                                                             "Segments in a quarter circle"}};
    return kTable;
  }
};

/// The light's left half is red and its right half blue, so that shadows separate into two colours.
Scene buildTwoColourLight(const TwoColourSettings& settings) {
  const int cells = settings.tessellation;
  Scene scene;
  addGround(scene, 9.0);
  addPart(scene, "sphere", sphere({-0.45, 0.4, 0.1}, 0.4, cells), {0.75F, 0.75F, 0.75F});
  addPart(scene, "cone", frustum({0.55, 0.0, -0.1}, {0.55, 1.0, -0.1}, 0.35, 0.0, 4 * cells),
          {0.75F, 0.75F, 0.75F});
  frameStanding(scene, 1.0, 1.0);
  AreaLight& light = scene.lights[0];
  light.size = {0.6, 0.4};
  light.parts = {{{{0.0, 0.0}, {0.5, 0.0}, {0.5, 1.0}, {0.0, 1.0}}, {1.0F, 0.15F, 0.1F}},
                 {{{0.5, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.5, 1.0}}, {0.1F, 0.25F, 1.0F}}};
  return scene;
}

/// A picture without any symmetry: a bright letter F on two ramps. Seven columns by nine rows, the first row
/// at the bottom.
glm::vec3 pictureAt(glm::dvec2 unit) {
  constexpr std::array<const char*, 9> kRows = {".......", "..#....", "..#....", "..#....", "..####.",
                                                "..#....", "..#....", "..#####", "......."};
  const auto column = static_cast<size_t>(unit.x * 7.0), row = static_cast<size_t>(unit.y * 9.0);
  const bool letter = kRows.at(row)[column] == '#';
  return letter ? glm::vec3(1.0F, 0.85F, 0.2F) : glm::vec3(0.1F + 0.3F * unit.x, 0.05F, 0.2F + 0.6F * unit.y);
}

struct TexturedLightSettings {
  int cells = 8;
  static const SettingsTable<TexturedLightSettings>& table() {
    static const SettingsTable<TexturedLightSettings> kTable = {
        {&TexturedLightSettings::cells, "cells", {2, 32}, "cells", "Cells per side of the picture"}};
    return kTable;
  }
};

/// The light is a picture of square cells.
Scene buildTexturedLight(const TexturedLightSettings& settings) {
  const int cells = settings.cells;
  Scene scene;
  addGround(scene, 9.0);
  addPart(scene, "sphere", sphere({-0.45, 0.4, 0.1}, 0.4, 16), {0.75F, 0.75F, 0.75F});
  addPart(scene, "cone", frustum({0.55, 0.0, -0.1}, {0.55, 1.0, -0.1}, 0.35, 0.0, 64), {0.75F, 0.75F, 0.75F});
  frameStanding(scene, 1.0, 1.0);
  AreaLight& light = scene.lights[0];
  light.size = {0.8, 0.8};
  light.parts.clear();
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const glm::dvec2 low = glm::dvec2(i, j) / double(cells),
                       high = glm::dvec2(i + 1, j + 1) / double(cells);
      light.parts.push_back({{low, {high.x, low.y}, high, {low.x, high.y}}, pictureAt(0.5 * (low + high))});
    }
  return scene;
}

const RegisteredScene<SphereGridSettings> kSphereGrid{
    {.name = "sphere_grid",
     .version = 1,
     .summary = "Cubic grid of spheres over a plane: overlapping occluders at many depths",
     .source = "Schwarz 2009, Fig. 4.33"},
    buildSphereGrid};

const RegisteredScene<TwoColourSettings> kTwoColourLight{
    {.name = "two_colour_light",
     .version = 1,
     .summary = "Sphere and cone under a light whose halves differ in colour",
     .source = "stand-in for Schwarz 2009, Fig. 4.4"},
    buildTwoColourLight};

const RegisteredScene<TexturedLightSettings> kTexturedLight{
    {.name = "textured_light",
     .version = 1,
     .summary = "Sphere and cone under a light that shows a picture",
     .source = "Schwarz 2009, section 4.2.2"},
    buildTexturedLight};

}  // namespace
}  // namespace limen::scene

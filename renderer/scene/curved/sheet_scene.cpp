// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <random>
#include <tuple>

#include "renderer/scene/curved/patch_mesh.h"
#include "renderer/scene/stage.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::scene {
namespace {

struct SheetSettings {
  int columns = 16, rows = 16;
  double relief = 0.5;
  bool turned = false;
  int64_t seed = 1;
  int tessellation = 4;
  static const SettingsTable<SheetSettings>& table() {
    using S = SheetSettings;
    static const SettingsTable<S> kTable = {
        {&S::columns, "columns", {1, 1024}, "patches", "Patches along x"},
        {&S::rows, "rows", {1, 1024}, "patches", "Patches along z"},
        {&S::relief, "relief", {0.0, 10.0}, "", "Largest height of a control point, in widths of a patch"},
        {&S::turned, "turned",
         "Turn the parameters of each patch by a quarter turn more than its neighbour's, so that common sides run "
         "in all combinations of directions"},
        {&S::seed, "seed", {0, 1e9}, "", "Seed of the heights"},
        {&S::tessellation, "tessellation", {1, 64}, "segments", "Segments along each side of a patch in the mesh"}};
    return kTable;
  }
};

/// A wavy sheet of bicubic patches, 1 wide, without creases: control points on common sides lie in the middle
/// of those beside them.
surfaces::PatchSet sheet(const SheetSettings& settings) {
  const int width = 3 * settings.columns + 1, depth = 3 * settings.rows + 1;
  const double patch = 1.0 / settings.columns;
  std::mt19937_64 random(static_cast<uint64_t>(settings.seed));
  std::vector<double> heights(static_cast<size_t>(width) * static_cast<size_t>(depth));
  const auto height = [&](int i, int j) -> double& {
    return heights[static_cast<size_t>(std::clamp(i, 0, width - 1)) +
                   static_cast<size_t>(width) * static_cast<size_t>(std::clamp(j, 0, depth - 1))];
  };
  // The generator's own words, as distributions differ between standard libraries.
  for (double& h : heights) h = settings.relief * patch * (double(random() >> 11) / double(1ULL << 52) - 1.0);
  for (int j = 0; j < depth; ++j)
    for (int i = 3; i + 1 < width; i += 3) height(i, j) = 0.5 * (height(i - 1, j) + height(i + 1, j));
  for (int j = 3; j + 1 < depth; j += 3)
    for (int i = 0; i < width; ++i) height(i, j) = 0.5 * (height(i, j - 1) + height(i, j + 1));
  surfaces::PatchSet set;
  for (int row = 0; row < settings.rows; ++row)
    for (int column = 0; column < settings.columns; ++column) {
      const int turns = settings.turned ? (column + 2 * row) % 4 : 0;
      std::array<glm::dvec4, 16> points;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
          int a = i, b = j;
          for (int turn = 0; turn < turns; ++turn) std::tie(a, b) = std::pair(3 - b, a);
          // u to the right and v towards the back: the sheet faces up.
          const int x = 3 * column + a, z = 3 * row + b;
          points[static_cast<size_t>(i + 4 * j)] =
              surfaces::weighted({x * patch / 3.0 - 0.5, height(x, z), (0.5 * settings.rows - z / 3.0) * patch});
        }
      surfaces::addRectangle(set, 3, 3, points);
    }
  return set;
}

Scene buildSheet(const SheetSettings& settings) {
  Scene scene;
  addSurface(scene, "sheet", sheet(settings), settings.tessellation, {0.6F, 0.64F, 0.7F});
  const double reach = 0.5 * std::max(1.0, double(settings.rows) / settings.columns);
  scene.lights.push_back(lightTowards({-2.0 * reach, 3.0 * reach, 1.0 * reach}, glm::dvec3(0.0), glm::dvec2(0.2)));
  setStillCamera(scene, orbitCamera(glm::dvec3(0.0), 3.4 * reach, 20.0, 40.0));
  return scene;
}

const RegisteredScene<SheetSettings> kSheet{
    {.name = "curved/sheet",
     .version = 1,
     .summary = "A wavy sheet of bicubic patches, as many as asked for",
     .source = "bench"},
    buildSheet};

}  // namespace
}  // namespace limen::scene

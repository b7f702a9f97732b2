// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
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
         "Turn the parameters of each patch by a quarter turn more than its neighbour's, so that common "
         "sides run "
         "in all combinations of directions"},
        {&S::seed, "seed", {0, 1e9}, "", "Seed of the heights"},
        {&S::tessellation,
         "tessellation",
         {1, 64},
         "segments",
         "Segments along each side of a patch in the mesh"}};
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
          points[static_cast<size_t>(i + 4 * j)] = surfaces::weighted(
              {x * patch / 3.0 - 0.5, height(x, z), (0.5 * settings.rows - z / 3.0) * patch});
        }
      surfaces::addRectangle(set, 3, 3, points);
    }
  return set;
}

struct FlagSettings {
  int columns = 12, rows = 8;
  double amplitude = 0.08, waves = 1.5, periodS = 2.0, startS = 0.0;
  int tessellation = 4;
  static const SettingsTable<FlagSettings>& table() {
    using S = FlagSettings;
    static const SettingsTable<S> kTable = {
        {&S::columns, "columns", {1, 256}, "patches", "Patches along the flag"},
        {&S::rows, "rows", {1, 256}, "patches", "Patches from its top to its bottom"},
        {&S::amplitude,
         "amplitude",
         {0.0, 1.0},
         "",
         "Largest displacement, at the free end, in lengths of the flag"},
        {&S::waves, "waves", {0.1, 20.0}, "", "Waves along the flag"},
        {&S::periodS, "period_s", {0.1, 60.0}, "s", "Time in which a wave runs its own length"},
        {&S::startS, "start_s", {0.0, 60.0}, "s", "Time of the motion at which the scene begins"},
        {&S::tessellation,
         "tessellation",
         {1, 64},
         "segments",
         "Segments along each side of a patch in the mesh"}};
    return kTable;
  }
};

/// Smooth sums over a net: those on common sides lie in the middle of those beside them.
void smoothen(std::vector<glm::dvec3>& net, int width, int height) {
  const auto at = [&](int i, int j) -> glm::dvec3& {
    return net[static_cast<size_t>(i) + static_cast<size_t>(width) * static_cast<size_t>(j)];
  };
  for (int j = 0; j < height; ++j)
    for (int i = 3; i + 1 < width; i += 3) at(i, j) = 0.5 * (at(i - 1, j) + at(i + 1, j));
  for (int j = 3; j + 1 < height; j += 3)
    for (int i = 0; i < width; ++i) at(i, j) = 0.5 * (at(i, j - 1) + at(i, j + 1));
}

/// A flag of bicubic patches, 1 long, that hangs at its left end; waves run along it and grow. Parameters of
/// patches are turned against their neighbours'.
surfaces::PatchSet flag(const FlagSettings& settings) {
  const int width = 3 * settings.columns + 1, height = 3 * settings.rows + 1;
  std::vector<glm::dvec3> rest, sine, cosine;
  for (int j = 0; j < height; ++j)
    for (int i = 0; i < width; ++i) {
      const double x = i / (width - 1.0), y = 0.6 * j / (height - 1.0);
      const double phase = 2.0 * M_PI * (settings.waves * x + 0.5 * y - settings.startS / settings.periodS);
      const double reach = settings.amplitude * x * (2.0 - x);
      // sin(phase - 2 pi t / period), and a sway along the flag that keeps it about as long.
      const glm::dvec3 out(0.0, 0.0, reach), along(0.3 * reach, 0.0, 0.0);
      rest.emplace_back(x - 0.5, y + 0.35, 0.0);
      sine.push_back(-std::cos(phase) * out + std::cos(phase + 1.0) * along);
      cosine.push_back(std::sin(phase) * out - std::sin(phase + 1.0) * along);
    }
  for (std::vector<glm::dvec3>* net : {&rest, &sine, &cosine}) smoothen(*net, width, height);
  surfaces::PatchSet set;
  set.motion.periodS = settings.periodS;
  for (int row = 0; row < settings.rows; ++row)
    for (int column = 0; column < settings.columns; ++column) {
      std::array<glm::dvec4, 16> points;
      for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
          int a = i, b = j;
          for (int turn = 0; turn < (column + 2 * row) % 4; ++turn) std::tie(a, b) = std::pair(3 - b, a);
          const auto from = static_cast<size_t>(3 * column + a) +
                            static_cast<size_t>(width) * static_cast<size_t>(3 * row + b);
          points[static_cast<size_t>(i + 4 * j)] = surfaces::weighted(rest[from]);
          set.motion.sine.push_back(sine[from]), set.motion.cosine.push_back(cosine[from]);
        }
      surfaces::addRectangle(set, 3, 3, points);
    }
  return set;
}

Scene buildFlag(const FlagSettings& settings) {
  Scene scene;
  addGround(scene, 9.0);
  addSurface(scene, "flag", flag(settings), settings.tessellation, {0.72F, 0.5F, 0.42F});
  frameStanding(scene, 1.0, 0.6);
  setStillCamera(scene, orbitCamera({0.0, 0.55, 0.0}, 2.3, 25.0, 36.0));
  return scene;
}

Scene buildSheet(const SheetSettings& settings) {
  Scene scene;
  addSurface(scene, "sheet", sheet(settings), settings.tessellation, {0.6F, 0.64F, 0.7F});
  const double reach = 0.5 * std::max(1.0, double(settings.rows) / settings.columns);
  scene.lights.push_back(
      lightTowards({-2.0 * reach, 3.0 * reach, 1.0 * reach}, glm::dvec3(0.0), glm::dvec2(0.2)));
  setStillCamera(scene, orbitCamera(glm::dvec3(0.0), 3.4 * reach, 20.0, 40.0));
  return scene;
}

const RegisteredScene<SheetSettings> kSheet{
    {.name = "curved/sheet",
     .version = 1,
     .summary = "A wavy sheet of bicubic patches, as many as asked for",
     .source = "bench"},
    buildSheet};

const RegisteredScene<FlagSettings> kFlag{
    {.name = "curved/flag",
     .version = 1,
     .summary = "A flag of bicubic patches along which waves run: control points that move",
     .source = "bench"},
    buildFlag};

}  // namespace
}  // namespace limen::scene

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::scene {
namespace {

struct CombSettings {
  int slats = 24;
  double width = 0.4;
  static const SettingsTable<CombSettings>& table() {
    using S = CombSettings;
    static const SettingsTable<S> kTable = {
        {&S::slats, "slats", {1, 256}, "slats", "Slats over the 2.4 m of the fence"},
        {&S::width, "width", {0.02, 0.95}, "", "Width of a slat as a share of the slats' pitch"}};
    return kTable;
  }
};

/// Fence of slats along x. With many slats one is narrower than a shadow-map texel, and the penumbrae of
/// neighbours overlap far from the foot.
Scene buildComb(const CombSettings& settings) {
  const int slats = settings.slats;
  constexpr double kLength = 2.4, kHeight = 1.0, kThickness = 0.02;
  const double pitch = kLength / slats, width = settings.width * pitch;
  Mesh fence;
  for (int i = 0; i < slats; ++i) {
    const double x = -0.5 * kLength + (i + 0.5) * pitch;
    append(fence,
           box({x - 0.5 * width, 0.0, -0.5 * kThickness}, {x + 0.5 * width, kHeight, 0.5 * kThickness}));
  }
  append(fence, box({-0.5 * kLength, 0.8, 0.5 * kThickness}, {0.5 * kLength, 0.86, 1.5 * kThickness}));
  Scene scene;
  addGround(scene, 11.0);
  addPart(scene, "fence", fence, {0.65F, 0.5F, 0.35F});
  scene.lights = {lightTowards({-1.2, 4.0, -2.0}, {0.0, 0.2, 0.3}, {0.35, 0.35})};
  setStillCamera(scene, orbitCamera({0.1, 0.35, 0.4}, 4.4, 12.0, 38.0));
  return scene;
}

const RegisteredScene<CombSettings> kCombRegistered{
    {.name = "comb",
     .version = 1,
     .summary = "Fence of thin slats: many narrow occluders side by side",
     .source = "bench"},
    buildComb};

}  // namespace
}  // namespace limen::scene

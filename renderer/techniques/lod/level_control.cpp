// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/lod/level_control.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limen::techniques {

const SettingsTable<ByDistance>& ByDistance::table() {
  static const SettingsTable<ByDistance> kTable = {Binding(&ByDistance::factor, "factor",
                                                           Range{0.001, 1000.0}, "",
                                                           "Multiplies the scene's switch distances")
                                                       .formerly({"distance_factor"})};
  return kTable;
}

const SettingsTable<ByExtent>& ByExtent::table() {
  static const SettingsTable<ByExtent> kTable = {
      Binding(&ByExtent::finestPx, "finest_px", Range{1.0, 8192.0}, "px",
              "The finest level is shown from this screen height upwards")
          .formerly({"extent_px"}),
      Binding(&ByExtent::ratio, "ratio", Range{0.05, 0.95}, "",
              "Each further level is shown from this share of the previous level's height")
          .formerly({"extent_ratio"})};
  return kTable;
}

const SettingsTable<ByError>& ByError::table() {
  static const SettingsTable<ByError> kTable = {
      Binding(&ByError::tolerancePx, "tolerance_px", Range{0.0, 1000.0}, "px",
              "Largest projected deviation from the finest level",
              "Schwarz 2009, section 10.1 (half a pixel by convention)")
          .formerly({"tolerance_px"})};
  return kTable;
}

const SettingsTable<ByLevel>& ByLevel::table() {
  static const SettingsTable<ByLevel> kTable = {Binding(&ByLevel::level, "level", Range{0, 15}, "",
                                                        "0 is the finest; clamped to each object's coarsest")
                                                    .formerly({"level"})};
  return kTable;
}

const SettingsTable<LevelControlSettings>& LevelControlSettings::table() {
  using S = LevelControlSettings;
  static const SettingsTable<S> kTable = {
      {&S::control, "control", "How an object's level is chosen", "Schwarz 2009, sections 2.4, 9.5 and 10.1"},
      {&S::frameRateHz,
       "frame_rate",
       {1.0, 1000.0},
       "Hz",
       "Frame rate at which level switches are counted along the camera path"}};
  return kTable;
}

scene::LodSelection LevelControl::choose(const scene::Scene& scene, const scene::LodView& view) const {
  const auto& control = settings_.control;
  if (const auto* by = std::get_if<ByDistance>(&control)) return levelsByDistance(scene, view, by->factor);
  if (const auto* by = std::get_if<ByExtent>(&control))
    return levelsByScreenExtent(scene, view, by->finestPx, by->ratio);
  if (const auto* by = std::get_if<ByError>(&control))
    return levelsByScreenError(scene, view, by->tolerancePx);
  return uniformLevels(scene, std::get<ByLevel>(control).level);
}

int64_t LevelControl::switchesOnPath(const scene::Scene& scene, int heightPx) const {
  if (scene.camera.keys.size() < 2) return 0;
  const double start = scene.camera.keys.front().timeS;
  const auto frames =
      static_cast<int64_t>(std::floor(scene.camera.durationS() * settings_.frameRateHz + 1e-9));
  int64_t switches = 0;
  scene::LodSelection before;
  for (int64_t i = 0; i <= frames; ++i) {
    const scene::LodSelection now =
        choose(scene, {scene.camera.at(start + static_cast<double>(i) / settings_.frameRateHz), heightPx});
    for (size_t object = 0; i > 0 && object < now.levels.size(); ++object)
      switches += now.levels[object] != before.levels[object];
    before = now;
  }
  return switches;
}

std::vector<Counter> LevelControl::counters(const scene::Scene& scene, const scene::LodView& view) const {
  std::vector<Counter> out = selectionCounters(scene, choose(scene, view), view);
  out.push_back({"level_switches", static_cast<double>(switchesOnPath(scene, view.heightPx))});
  return out;
}

std::vector<Counter> selectionCounters(const scene::Scene& scene, const scene::LodSelection& selection,
                                       const scene::LodView& view) {
  double levels = 0.0;
  for (const int level : selection.levels) levels += level;
  // An eye inside an object's bounds makes the bound infinite, which tables cannot hold.
  const double error = std::min(largestScreenErrorPx(scene, selection, view), 1e9);
  return {{"triangles_drawn", static_cast<double>(triangleCount(scene, selection))},
          {"level_mean", levels / static_cast<double>(std::max<size_t>(selection.levels.size(), 1))},
          {"screen_error_px", error}};
}

Quantity trianglesDrawn() { return {"triangles_drawn", "Triangles drawn", "", Direction::LowerIsBetter}; }
Quantity screenErrorPx() {
  return {"screen_error_px", "Largest screen-space deviation", "px", Direction::Neither,
          "Schwarz 2009, section 10.1"};
}
Quantity levelSwitches() { return {"level_switches", "Level switches", "", Direction::Neither}; }

std::vector<Quantity> selectionQuantities() {
  return {trianglesDrawn(), {"level_mean", "Mean level", "", Direction::Neither}, screenErrorPx()};
}

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/lod/level_control.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limen::techniques {

LevelControl::LevelControl(const ParameterValues& values)
    : control_(values.text("control")),
      level_(static_cast<int>(values.integer("level"))),
      distanceFactor_(values.real("distance_factor")),
      extentPx_(values.real("extent_px")),
      extentRatio_(values.real("extent_ratio")),
      tolerancePx_(values.real("tolerance_px")),
      frameRateHz_(values.real("frame_rate")) {}

std::vector<Parameter> LevelControl::parameters() {
  return {
      choiceParameter("control", "distance", {"fixed_level", "distance", "screen_extent", "screen_error"},
                      "What decides an object's level", "Schwarz 2009, sections 2.4, 9.5 and 10.1"),
      integerParameter("level", 0, 0, 15, "",
                       "fixed_level: level of all objects, 0 the finest; past an object's last: its last"),
      realParameter("distance_factor", 1.0, 0.001, 1000.0, "",
                    "distance: multiplies the scene's switch distances"),
      realParameter("extent_px", 256.0, 1.0, 8192.0, "px",
                    "screen_extent: the finest level is shown from this height on the screen up"),
      realParameter("extent_ratio", 0.5, 0.05, 0.95, "",
                    "screen_extent: each further level from this share of the one before"),
      realParameter("tolerance_px", 0.5, 0.0, 1000.0, "px",
                    "screen_error: largest projected deviation from the finest level",
                    "Schwarz 2009, section 10.1 (half a pixel by convention)"),
      realParameter("frame_rate", 60.0, 1.0, 1000.0, "Hz",
                    "At which switches of level are counted along the camera path")};
}

scene::LodSelection LevelControl::choose(const scene::Scene& scene, const scene::LodView& view) const {
  if (control_ == "distance") return levelsByDistance(scene, view, distanceFactor_);
  if (control_ == "screen_extent") return levelsByScreenExtent(scene, view, extentPx_, extentRatio_);
  if (control_ == "screen_error") return levelsByScreenError(scene, view, tolerancePx_);
  return uniformLevels(scene, level_);
}

int64_t LevelControl::switchesOnPath(const scene::Scene& scene, int heightPx) const {
  if (scene.camera.keys.size() < 2) return 0;
  const double start = scene.camera.keys.front().timeS;
  const auto frames = static_cast<int64_t>(std::floor(scene.camera.durationS() * frameRateHz_ + 1e-9));
  int64_t switches = 0;
  scene::LodSelection before;
  for (int64_t i = 0; i <= frames; ++i) {
    const scene::LodSelection now =
        choose(scene, {scene.camera.at(start + static_cast<double>(i) / frameRateHz_), heightPx});
    for (size_t object = 0; i > 0 && object < now.levels.size(); ++object)
      switches += now.levels[object] != before.levels[object];
    before = now;
  }
  return switches;
}

std::vector<Counter> LevelControl::counters(const scene::Scene& scene, const scene::LodView& view) const {
  std::vector<Counter> out = selectionCounters(scene, choose(scene, view), view);
  out.push_back({"level_switches", static_cast<double>(switchesOnPath(scene, view.heightPx)), "", false});
  return out;
}

std::vector<Counter> selectionCounters(const scene::Scene& scene, const scene::LodSelection& selection,
                                       const scene::LodView& view) {
  double levels = 0.0;
  for (const int level : selection.levels) levels += level;
  // An eye inside an object's bounds makes the bound infinite, which no table holds.
  const double error = std::min(largestScreenErrorPx(scene, selection, view), 1e9);
  return {
      {"triangles_drawn", static_cast<double>(triangleCount(scene, selection)), "", true},
      {"level_mean", levels / static_cast<double>(std::max<size_t>(selection.levels.size(), 1)), "", false},
      {"screen_error_px", error, "px", false}};
}

}  // namespace limen::techniques

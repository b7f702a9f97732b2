// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/base/parameter.h"
#include "renderer/scene/lod_control.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

/// How a technique chooses the levels of a frame: the conventional ways (SP-57), none of which looks at the
/// picture.
class LevelControl {
 public:
  explicit LevelControl(const ParameterValues& values);
  /// control, level, distance_factor, extent_px, extent_ratio, tolerance_px, frame_rate.
  static std::vector<Parameter> parameters();

  scene::LodSelection choose(const scene::Scene& scene, const scene::LodView& view) const;
  /// Changes of level of any object on the scene's whole camera path, met at the frame rate.
  int64_t switchesOnPath(const scene::Scene& scene, int heightPx) const;
  /// triangles_drawn, level_mean, screen_error_px, level_switches of a frame with the chosen levels.
  std::vector<Counter> counters(const scene::Scene& scene, const scene::LodView& view) const;

 private:
  std::string control_;
  int level_;
  double distanceFactor_, extentPx_, extentRatio_, tolerancePx_, frameRateHz_;
};

/// triangles_drawn, level_mean and screen_error_px of a selection.
std::vector<Counter> selectionCounters(const scene::Scene& scene, const scene::LodSelection& selection,
                                       const scene::LodView& view);

}  // namespace limen::techniques

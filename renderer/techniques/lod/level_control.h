// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>
#include <vector>

#include "experiments/base/settings_table.h"
#include "renderer/scene/lod_control.h"
#include "renderer/techniques/technique.h"

namespace limen::techniques {

// How an object's level is chosen: the conventional ways (SP-57), none of which considers the picture.

struct ByDistance {
  static constexpr const char *kKind = "distance", *kSummary = "by the scene's switch distances";
  double factor = 1.0;  ///< multiplies the switch distances
  static const SettingsTable<ByDistance>& table();
};

struct ByExtent {
  static constexpr const char *kKind = "extent", *kSummary = "by the object's screen height";
  double finestPx = 256.0;  ///< height from which the finest level is shown
  double ratio = 0.5;       ///< ratio of the heights from which a level and the previous one are shown
  static const SettingsTable<ByExtent>& table();
};

struct ByError {
  static constexpr const char *kKind = "error", *kSummary = "by the level's screen-space deviation";
  double tolerancePx = 0.5;
  static const SettingsTable<ByError>& table();
};

struct ByLevel {
  static constexpr const char *kKind = "fixed", *kSummary = "one level for all objects";
  int level = 0;  ///< 0 is the finest; clamped to each object's coarsest
  static const SettingsTable<ByLevel>& table();
};

struct LevelControlSettings {
  std::variant<ByDistance, ByExtent, ByError, ByLevel> control;
  double frameRateHz = 60.0;  ///< rate at which switches are counted
  static const SettingsTable<LevelControlSettings>& table();
};

/// How a technique chooses the levels of a frame.
class LevelControl {
 public:
  explicit LevelControl(LevelControlSettings settings) : settings_(settings) {}

  scene::LodSelection choose(const scene::Scene& scene, const scene::LodView& view) const;
  /// Level changes of any object along the scene's whole camera path, sampled at the frame rate.
  int64_t switchesOnPath(const scene::Scene& scene, int heightPx) const;
  /// triangles_drawn, level_mean, screen_error_px, level_switches of a frame with the chosen levels.
  std::vector<Counter> counters(const scene::Scene& scene, const scene::LodView& view) const;

 private:
  LevelControlSettings settings_;
};

/// triangles_drawn, level_mean and screen_error_px of a selection.
std::vector<Counter> selectionCounters(const scene::Scene& scene, const scene::LodSelection& selection,
                                       const scene::LodView& view);
/// Their declarations.
std::vector<Quantity> selectionQuantities();
Quantity trianglesDrawn();
Quantity screenErrorPx();
Quantity levelSwitches();

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "experiments/stage.h"
#include "experiments/viewer/choices.h"

namespace limen::viewer {

/// A built scene whose camera moves without building it again.
class SceneStage {
 public:
  /// Builds the scene if it is another one than before, and moves its camera to where the choice has it.
  /// True if it was built. Throws Error; then there is no scene.
  bool choose(const experiments::Choice& scene);
  /// What choose() has left; there must be one.
  const experiments::Stage& stage() const { return *stage_; }
  bool empty() const { return !stage_; }
  /// Whether choose() would build a scene, and end the one there is.
  bool needsBuilding(const experiments::Choice& scene) const { return !stage_ || keyOf(scene) != key_; }
  /// Of the chosen camera, from its own time 0 whatever time is chosen.
  const scene::CameraPath& path() const { return path_; }

 private:
  static std::string keyOf(const experiments::Choice& scene);

  std::string key_;
  std::unique_ptr<experiments::Stage> stage_;
  scene::CameraPath built_, path_;
};

}  // namespace limen::viewer

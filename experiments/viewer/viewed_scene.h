// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "experiments/executor.h"
#include "renderer/frame/scene_on_gpu.h"

namespace limen::viewer {

/// A built scene whose camera can move without rebuilding it.
class ViewedScene {
 public:
  /// Builds the scene if it differs from the one before in more than its camera, and moves the camera. True
  /// if it was built. Throws Error; then there is no scene.
  bool show(const experiments::Configuration& scene);
  /// The scene from show(); there must be one.
  const frame::SceneOnGpu& get() const { return *onGpu_; }
  bool empty() const { return !onGpu_; }
  /// Whether show() would build a new scene and destroy the current one.
  bool needsBuilding(const experiments::Configuration& scene) const {
    return !onGpu_ || keyOf(scene) != key_;
  }
  /// Of the camera, from its own time 0, whatever time is shown.
  const scene::CameraPath& path() const { return path_; }

 private:
  static std::string keyOf(const experiments::Configuration& scene);

  std::string key_;
  std::unique_ptr<frame::SceneOnGpu> onGpu_;
  scene::CameraPath built_, path_;
};

}  // namespace limen::viewer

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <utility>

#include "renderer/frame/gpu_scene.h"
#include "renderer/scene/scene.h"

namespace limen::frame {

/// A scene with its geometry on the GPU, in the current OpenGL context. It cannot be copied or
/// moved: `gpu` refers to `scene`. Lights and camera of `scene` may change; its geometry may not.
struct SceneOnGpu {
  explicit SceneOnGpu(scene::Scene built) : scene(std::move(built)), gpu(scene) {}

  scene::Scene scene;
  GpuScene gpu;
};

}  // namespace limen::frame

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "experiments/base/image.h"
#include "experiments/executor.h"
#include "renderer/frame/gpu_scene.h"
#include "renderer/gl/context.h"
#include "renderer/scene/scene.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {

/// What judging and pictures need of a view beside the product.
struct ViewImages {
  Image mask;     ///< 1 channel: 1 on receivers, 0 elsewhere
  Image shading;  ///< 3 channels: albedo by the cosine to the light's centre, unshadowed
};

/// Content hash, triangles and bounds of a scene, as a run records them.
nlohmann::json factsOf(const scene::Scene& scene);

/// A scene, built and on the GPU.
struct Stage {
  explicit Stage(scene::Scene built) : scene(std::move(built)), gpu(scene) {}
  ViewImages view(gl::Context& context, glm::ivec2 sizePx) const;

  scene::Scene scene;
  frame::GpuScene gpu;
};

/// Throws Error where the scene lacks what the technique needs.
void requireTraits(const techniques::TechniqueInfo& info, const scene::Scene& scene);

/// The product of a technique made for this one frame. Throws what the technique throws, and where the driver
/// reported a mistake.
Image renderOnce(gl::Context& context, const Stage& stage, glm::ivec2 sizePx, const Choice& technique);

}  // namespace limen::experiments

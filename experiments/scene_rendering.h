// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <nlohmann/json.hpp>

#include "experiments/base/image.h"
#include "experiments/executor.h"
#include "perception/metrics/metric.h"
#include "renderer/frame/frame.h"
#include "renderer/frame/scene_on_gpu.h"
#include "renderer/gl/context.h"
#include "renderer/scene/scene.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {

/// What metrics and pictures need of a view besides the product.
struct ViewImages {
  Image mask;     ///< 1 channel: 1 on receivers, 0 elsewhere
  Image mirrors;  ///< 1 channel: 1 where a pixel sees a mirror; empty if the scene has none
  Image shading;  ///< 3 channels: albedo times the cosine towards the light's centre, unshadowed
};

ViewImages viewImages(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx);

/// A scene's surfaces as viewers see them, for products that are shares of the direct light.
class ShownSurfaces {
 public:
  /// At the frame's time and with its scene's light. `frame` has begun.
  static perception::LitSurfaces of(frame::Frame& frame);

  ShownSurfaces(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx);
  const perception::LitSurfaces& textures() const { return textures_; }

 private:
  frame::Frame frame_;
  perception::LitSurfaces textures_;
};

/// What metrics take a product of this kind for.
perception::Depicts depicts(techniques::ProductKind kind);

/// Content hash, triangles and bounds, as a run records them.
nlohmann::json sceneFacts(const scene::Scene& scene);

/// Throws Error if the scene lacks something that the technique needs.
void requireTraits(const techniques::TechniqueInfo& info, const scene::Scene& scene);

/// The product of a technique made for this single frame, with the technique's remarks. Throws what the
/// technique throws, and Error if the driver reported a problem.
struct RenderedOnce {
  Image product;
  std::vector<std::string> remarks;
};
RenderedOnce renderWithRemarks(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx,
                               const Configuration& technique);
/// The product alone.
Image renderOnce(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx,
                 const Configuration& technique);

}  // namespace limen::experiments

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "experiments/executor.h"
#include "experiments/reference_cache.h"
#include "perception/metrics/path.h"
#include "renderer/frame/scene_on_gpu.h"
#include "renderer/gl/context.h"
#include "renderer/techniques/technique.h"

namespace limen::experiments {

/// Renders a run's technique and its reference along a path, for metrics that evaluate changes. On a path of
/// the camera alone, one technique renders all frames and may carry something from each to the next. Where
/// the light moves, shadow maps are fitted anew: each frame is rendered on its own, but by techniques that
/// follow the light (TechniqueInfo::followsLight).
class FramePath {
 public:
  /// `references` holds the references' products; `identity`: what else determines these, besides time and
  /// light.
  FramePath(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx, const PlannedRun& run,
            ReferenceCache& references, std::string identity);

  /// Visits every step. Throws Error if the camera is to move and has no path, and like a technique.
  void render(const perception::PathRequest& request, const perception::PathVisitor& visit);
  /// Of the run's technique, on frames of the path: not those that it had as soon as it was prepared.
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  void note(const techniques::Technique* technique);
  std::shared_ptr<const Image> reference(const scene::Scene& scene, double timeS, double lightShare,
                                         double directionDeg);

  gl::Context& context_;
  const frame::SceneOnGpu& onGpu_;
  glm::ivec2 sizePx_;
  const PlannedRun& run_;
  ReferenceCache& references_;
  std::string identity_;
  std::vector<std::string> prepared_, remarks_;
};

}  // namespace limen::experiments

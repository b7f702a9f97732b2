// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/references/embree_scene.h"
#include "renderer/references/shadow_tracer.h"

namespace limen::references {

/// Shadow rays on the CPU, in packets, on all cores.
class EmbreeTracer : public ShadowTracer {
 public:
  /// `because`: why not on the GPU, if that was to be tried first.
  explicit EmbreeTracer(const Triangles& triangles, std::string because = {})
      : scene_(triangles), because_(std::move(because)) {}
  std::vector<ShadowCounts> trace(const std::vector<ReceiverPoint>& points, const LightSamples& samples,
                                  glm::dvec3 anchor) override;
  std::string remark() const override {
    return "Rays were traced on the CPU (Embree)" + (because_.empty() ? "." : ": " + because_ + ".");
  }
  const EmbreeScene& scene() const { return scene_; }

 private:
  EmbreeScene scene_;
  std::string because_;
};

}  // namespace limen::references

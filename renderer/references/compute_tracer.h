// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

#include "renderer/gl/buffer.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/references/shadow_tracer.h"

namespace limen::references {

/// Shadow rays on the GPU, generated there: no memory a ray, 64 bytes for each of 2^18 receivers at a time.
/// Dispatches are short (some 20 ms), so that no driver's watchdog ends them and cancelling takes effect
/// soon.
class ComputeTracer : public ShadowTracer {
 public:
  /// `scene` holds the triangles; both must outlive it.
  ComputeTracer(gl::Context& context, const ray_tracing::RayScene& scene, const Triangles& triangles);
  std::vector<ShadowCounts> trace(const std::vector<ReceiverPoint>& points, const LightSamples& samples,
                                  glm::dvec3 anchor) override;
  std::string remark() const override { return "Rays were traced on the GPU."; }
  int64_t bytes() const override { return scene_.bytes() + receivers_.bytes() + counts_.bytes(); }
  /// The points, relative to `anchor`, that the GPU sends the rays of a pixel to: samples.point() but for
  /// rounding in double precision.
  std::vector<glm::dvec3> lightPoints(gl::Context& context, const LightSamples& samples, glm::dvec3 anchor,
                                      uint32_t pixel);

 private:
  void setLight(const LightSamples& samples, glm::dvec3 anchor);
  /// The receivers in the buffer.
  void traceBatch(uint32_t receivers, const LightSamples& samples);

  const Triangles& triangles_;
  const ray_tracing::RayScene& scene_;
  const gl::Program& program_;
  gl::Buffer receivers_, counts_;
  std::optional<gl::Buffer> light_, outline_;
  uint32_t raysPerDispatch_;
  bool software_;
};

}  // namespace limen::references

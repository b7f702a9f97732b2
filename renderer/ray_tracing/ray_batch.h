// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/gl/context.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/ray_tracing/ray_tracing_bindings.h"

namespace limen::ray_tracing {

enum class Wanted { ClosestHit, AnyHit };

/// Given rays through a scene, on the GPU.
class RayBatch {
 public:
  /// `scene` must outlive it.
  RayBatch(gl::Context& context, const RayScene& scene, const std::vector<BatchRay>& rays, Wanted wanted);

  /// Starts a dispatch over all rays.
  void trace() const;
  /// One for each ray; waits for the GPU.
  std::vector<BatchHit> hits() const;

 private:
  const RayScene& scene_;
  const gl::Program& program_;
  uint32_t count_;
  gl::Buffer rays_, hits_;
};

}  // namespace limen::ray_tracing

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/ray_tracing/ray_tree.h"

namespace limen::ray_tracing {

enum class Wanted { ClosestHit, AnyHit };

/// Given rays through a tree, on the GPU.
class RayBatch {
 public:
  /// `tree` must outlive it.
  RayBatch(gl::Context& context, const RayTree& tree, const std::vector<BatchRay>& rays, Wanted wanted);

  /// Starts a dispatch over all rays.
  void trace() const;
  /// One for each ray; waits for the GPU.
  std::vector<BatchHit> hits() const;

 private:
  const RayTree& tree_;
  const gl::Program& program_;
  uint32_t count_;
  gl::Buffer rays_, hits_;
};

}  // namespace limen::ray_tracing

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/ray_tracing/ray_tree.h"
#include "renderer/ray_tracing/wide_bvh.h"

namespace limen::ray_tracing {

/// Triangles in GPU memory, ready for shaders that trace rays (trace.glsl).
class RayScene : public RayTree {
 public:
  /// Builds the tree and uploads it; the vertices are not needed afterwards. Throws Error if the device
  /// cannot hold it.
  RayScene(gl::Context& context, const std::vector<glm::vec3>& vertices,
           const std::vector<glm::uvec3>& triangles);

  void bind(const gl::Program& program) const override;
  /// Loop iterations that an invocation may take; beyond it a software renderer would leave loops silently.
  int mostIterations() const { return mostIterations_; }

  int64_t bytes() const override { return nodes_.bytes() + triangles_.bytes(); }
  double buildS() const { return buildS_; }  ///< of the tree
  uint32_t nodeCount() const { return nodeCount_; }
  uint32_t triangleCount() const { return triangleCount_; }  ///< without those left out
  int levels() const { return levels_; }

 private:
  RayScene(gl::Context& context, const WideBvh& tree, double buildS);
  static RayScene build(gl::Context& context, const std::vector<glm::vec3>& vertices,
                        const std::vector<glm::uvec3>& triangles);

  int mostIterations_, levels_;
  uint32_t nodeCount_, triangleCount_;
  double buildS_;
  gl::Buffer nodes_, triangles_;
};

}  // namespace limen::ray_tracing

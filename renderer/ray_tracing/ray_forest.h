// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/ray_tracing/ray_tree.h"

namespace limen::ray_tracing {

/// Triangles of a tree of its own.
struct TreeTriangles {
  std::span<const glm::vec3> vertices;
  std::span<const glm::uvec3> triangles;
  std::span<const uint32_t> numbers;  ///< what hits call each triangle
};

/// Trees of several objects, each in a space of its own, so that objects may move and no tree is built anew.
/// Shaders are compiled with RAY_FOREST and set rayRoot to the root of the object whose space the next ray is
/// in.
class RayForest : public RayTree {
 public:
  /// Throws Error if the device cannot hold it.
  RayForest(gl::Context& context, const std::vector<TreeTriangles>& objects);

  void bind(const gl::Program& program) const override;
  int64_t bytes() const override { return nodes_.bytes() + triangles_.bytes(); }
  /// Of each object; kRayNoRoot: it has no triangle that a ray could hit.
  const std::vector<uint32_t>& roots() const { return roots_; }
  double buildS() const { return buildS_; }  ///< of the trees

 private:
  struct Joined;
  RayForest(gl::Context& context, const Joined& joined);
  static Joined join(const std::vector<TreeTriangles>& objects);

  int mostIterations_;
  double buildS_;
  std::vector<uint32_t> roots_;
  uint32_t nodeCount_;
  gl::Buffer nodes_, triangles_;
};

}  // namespace limen::ray_tracing

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/ray_tracing/ray_tree.h"

namespace limen::ray_tracing {

/// Triangles in the cells of a uniform grid in GPU memory, for shaders that trace rays (trace.glsl) and are
/// compiled with RAY_GRID. What a tree is compared with: Gaitatzes 2012, section 4.7.1, traced his references
/// through one.
class TriangleGrid : public RayTree {
 public:
  /// Sorts the triangles on the CPU; the vertices are not needed afterwards. `density`: cells per triangle,
  /// of cubes as far as the extents allow and at most 256 along each (Cleary and Wyvill 1988). Triangles
  /// without area are left out.
  TriangleGrid(gl::Context& context, const std::vector<glm::vec3>& vertices,
               const std::vector<glm::uvec3>& triangles, double density);

  void bind(const gl::Program& program) const override;
  int64_t bytes() const override { return cells_.bytes() + triangles_.bytes(); }
  glm::ivec3 size() const { return size_; }

 private:
  struct Sorted {
    glm::vec3 low{0.0F}, cell{1.0F};
    glm::ivec3 size{0};
    std::vector<uint32_t> cells;  ///< first entry of each cell and the end; then the triangles' numbers
    std::vector<glm::vec4> triangles;
  };
  static Sorted sorted(const std::vector<glm::vec3>& vertices, const std::vector<glm::uvec3>& triangles,
                       double density);
  TriangleGrid(gl::Context& context, const Sorted& grid);

  int mostIterations_;
  glm::vec3 low_, cell_;
  glm::ivec3 size_;
  gl::Buffer cells_, triangles_;
};

}  // namespace limen::ray_tracing

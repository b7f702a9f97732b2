// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "renderer/gl/program.h"

namespace limen::ray_tracing {

/// A tree over triangles in GPU memory that shaders trace rays through (trace.glsl).
class RayTree {
 public:
  virtual ~RayTree() = default;
  /// Buffers and uniforms of trace.glsl, for the next dispatches of `program`.
  virtual void bind(const gl::Program& program) const = 0;
  virtual int64_t bytes() const = 0;
};

}  // namespace limen::ray_tracing

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "renderer/techniques/tessellation/surface_vertex_array.h"

namespace limen::techniques {

/// Vertices (TessellatedVertex) that transform feedback stores of what a vertex shader makes:
/// pattern.vert.glsl with CAPTURE. Of strips, each triangle's three.
class VertexFeedback {
 public:
  /// So many vertices; what does not fit is left out.
  explicit VertexFeedback(int64_t capacity);
  ~VertexFeedback();
  VertexFeedback(const VertexFeedback&) = delete;
  VertexFeedback& operator=(const VertexFeedback&) = delete;

  /// Stores what `draw` draws with the program in use, which it must not change: primitives of the kind
  /// (GL_POINTS or GL_TRIANGLES), of which the rasteriser still makes pixels.
  void capture(uint32_t primitive, const std::function<void()>& draw) const;
  /// What was stored last, with the bound program; the host need not know how much.
  void drawTriangles() const;

  const gl::Buffer& vertices() const { return vertices_; }

 private:
  uint32_t id_ = 0;
  gl::Buffer vertices_;
  SurfaceVertexArray array_;
};

}  // namespace limen::techniques

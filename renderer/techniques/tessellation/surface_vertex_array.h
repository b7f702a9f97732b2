// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/gl/buffer.h"

namespace limen::techniques {

/// Attributes of surface.vert.glsl from a buffer of TessellatedVertex, with or without indices.
class SurfaceVertexArray {
 public:
  explicit SurfaceVertexArray(const gl::Buffer& vertices);
  SurfaceVertexArray(const gl::Buffer& vertices, const gl::Buffer& indices);
  ~SurfaceVertexArray();
  SurfaceVertexArray(const SurfaceVertexArray&) = delete;
  SurfaceVertexArray& operator=(const SurfaceVertexArray&) = delete;
  /// Attribute 3, four floats a vertex.
  void setTrimPlaces(const gl::Buffer& places) const;
  void bind() const;

 private:
  uint32_t id_ = 0;
};

}  // namespace limen::techniques

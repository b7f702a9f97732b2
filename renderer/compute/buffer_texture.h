// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <epoxy/gl.h>

#include "renderer/gl/buffer.h"

namespace limen::compute {

/// A buffer as shaders of all stages may read it: storage blocks are not granted to vertex and geometry
/// shaders.
class BufferTexture {
 public:
  explicit BufferTexture(GLenum format) : format_(format) { glCreateTextures(GL_TEXTURE_BUFFER, 1, &id_); }
  ~BufferTexture() { glDeleteTextures(1, &id_); }
  BufferTexture(const BufferTexture&) = delete;
  BufferTexture& operator=(const BufferTexture&) = delete;
  void bind(uint32_t unit, const gl::Buffer& buffer) const {
    glTextureBuffer(id_, format_, buffer.id());
    glBindTextureUnit(unit, id_);
  }
  /// Texels that the driver grants.
  static int64_t mostTexels() {
    GLint out = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &out);
    return out;
  }

 private:
  GLenum format_;
  uint32_t id_ = 0;
};

/// For draws whose vertices come from elsewhere.
class NoVertices {
 public:
  NoVertices() { glCreateVertexArrays(1, &id_); }
  ~NoVertices() { glDeleteVertexArrays(1, &id_); }
  NoVertices(const NoVertices&) = delete;
  NoVertices& operator=(const NoVertices&) = delete;
  void bind() const { glBindVertexArray(id_); }

 private:
  uint32_t id_ = 0;
};

}  // namespace limen::compute

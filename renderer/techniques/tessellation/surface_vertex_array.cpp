// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/surface_vertex_array.h"

#include <epoxy/gl.h>

#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {

SurfaceVertexArray::SurfaceVertexArray(const gl::Buffer& vertices) {
  glCreateVertexArrays(1, &id_);
  glVertexArrayAttribFormat(id_, 0, 3, GL_FLOAT, GL_FALSE, offsetof(TessellatedVertex, position));
  glVertexArrayAttribIFormat(id_, 1, 1, GL_UNSIGNED_INT, offsetof(TessellatedVertex, material));
  glVertexArrayAttribFormat(id_, 2, 3, GL_FLOAT, GL_FALSE, offsetof(TessellatedVertex, normal));
  glVertexArrayAttribIFormat(id_, 4, 1, GL_UNSIGNED_INT, offsetof(TessellatedVertex, rung));
  for (const GLuint attribute : {0U, 1U, 2U, 4U}) {
    glVertexArrayAttribBinding(id_, attribute, 0);
    glEnableVertexArrayAttrib(id_, attribute);
  }
  glVertexArrayVertexBuffer(id_, 0, vertices.id(), 0, sizeof(TessellatedVertex));
}

SurfaceVertexArray::SurfaceVertexArray(const gl::Buffer& vertices, const gl::Buffer& indices)
    : SurfaceVertexArray(vertices) {
  glVertexArrayElementBuffer(id_, indices.id());
}

SurfaceVertexArray::~SurfaceVertexArray() { glDeleteVertexArrays(1, &id_); }

void SurfaceVertexArray::setTrimPlaces(const gl::Buffer& places) const {
  constexpr GLuint kAttribute = 3, kBinding = 1;
  glVertexArrayAttribFormat(id_, kAttribute, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(id_, kAttribute, kBinding);
  glEnableVertexArrayAttrib(id_, kAttribute);
  glVertexArrayVertexBuffer(id_, kBinding, places.id(), 0, 16);
}

void SurfaceVertexArray::bind() const { glBindVertexArray(id_); }

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/vertex_feedback.h"

#include <epoxy/gl.h>

#include "renderer/techniques/tessellation/tessellation_bindings.h"

namespace limen::techniques {

VertexFeedback::VertexFeedback(int64_t capacity)
    : vertices_(capacity * int64_t{sizeof(TessellatedVertex)}, nullptr), array_(vertices_) {
  glCreateTransformFeedbacks(1, &id_);
  glTransformFeedbackBufferBase(id_, 0, vertices_.id());
}

VertexFeedback::~VertexFeedback() { glDeleteTransformFeedbacks(1, &id_); }

void VertexFeedback::capture(uint32_t primitive, const std::function<void()>& draw) const {
  glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, id_);
  glBeginTransformFeedback(primitive);
  draw();
  glEndTransformFeedback();
  glBindTransformFeedback(GL_TRANSFORM_FEEDBACK, 0);
}

void VertexFeedback::drawTriangles() const {
  array_.bind();
  glDrawTransformFeedback(GL_TRIANGLES, id_);
}

}  // namespace limen::techniques

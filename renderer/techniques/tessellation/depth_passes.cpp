// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/depth_passes.h"

#include <epoxy/gl.h>

namespace limen::techniques {

DepthPasses::DepthPasses(frame::Frame& frame, const std::string& pass)
    : pass_(pass + "/passes"), depth_(gl::Format::Depth32F, frame.sizePx()), framebuffer_({}, &depth_) {
  frame.passes().setBytesHeld(pass_, depth_.bytes());
}

void DepthPasses::render(frame::Frame& frame, int count, const std::function<void(int)>& draw) const {
  const auto scope = frame.passes().open(pass_);
  framebuffer_.bind();
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDisable(GL_CULL_FACE);
  for (int i = 0; i < count; ++i) {
    constexpr GLfloat kFar = 0.0F;  // reversed depth
    glClearBufferfv(GL_DEPTH, 0, &kFar);
    draw(i);
  }
  glDisable(GL_DEPTH_TEST);
}

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/tessellation/patterns/crossings.h"

#include <epoxy/gl.h>

#include <array>

#include "renderer/gl/texture.h"

namespace limen::techniques {

uint32_t unevenCrossings(glm::ivec2 sizePx, const std::function<void()>& draw) {
  gl::Texture sums(gl::Format::R32F, sizePx);
  gl::Framebuffer framebuffer({&sums}, nullptr);
  framebuffer.bind();
  constexpr std::array<GLfloat, 4> kNone = {};
  glClearBufferfv(GL_COLOR, 0, kNone.data());
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE);
  draw();
  glDisable(GL_BLEND);
  const Image image = sums.read();
  uint32_t out = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) out += image.at(x, y, 0) != 0.0F;
  return out;
}

}  // namespace limen::techniques

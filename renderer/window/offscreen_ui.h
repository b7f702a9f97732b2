// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>

#include "renderer/gl/context.h"
#include "renderer/window/ui_surface.h"

namespace limen::window {

/// An interface in memory, for pictures of it without a display, and for tests: the caller sets mouse and
/// keys.
class OffscreenUi : public UiSurface {
 public:
  /// Throws Error if there is no OpenGL 4.5.
  explicit OffscreenUi(glm::ivec2 sizePx, float scale = 1.0F, UiDensity density = UiDensity::Workbench);
  ~OffscreenUi() override;

  gl::Context& context() override { return *context_; }
  glm::ivec2 sizePx() const override { return sizePx_; }
  void resize(glm::ivec2 sizePx);
  /// Waits until drawing is complete.
  void finish();

  /// From the next frame on. Buttons: 0 left, 1 right, 2 middle. Keys: as GLFW numbers them (letters and
  /// digits are their upper-case characters).
  void moveMouse(glm::vec2 toPx) { mousePx_ = toPx; }
  void press(int button, bool down) { buttons_[button] = down; }
  void scroll(float lines) { scrolled_ += lines; }
  void key(int key, bool down);
  void type(const std::string& utf8);

 protected:
  uint32_t framebuffer() const override { return framebuffer_; }
  void bindContext() const override { context_->makeCurrent(); }
  void beginUiFrame() override;

 private:
  void makeTarget();

  std::unique_ptr<gl::Context> context_;
  glm::ivec2 sizePx_;
  uint32_t framebuffer_ = 0, colour_ = 0;
  glm::vec2 mousePx_{-1.0F};
  bool buttons_[3] = {};
  float scrolled_ = 0.0F;
};

}  // namespace limen::window

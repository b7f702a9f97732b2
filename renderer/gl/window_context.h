// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "renderer/gl/context.h"

struct GLFWwindow;

namespace limen::gl {

/// A context with a window of its own (GLFW).
class WindowContext : public Context {
 public:
  /// Throws Error if there is no window system or no OpenGL 4.5 core.
  WindowContext(const std::string& title, glm::ivec2 sizePx, bool visible = true);
  ~WindowContext() override;

  void makeCurrent() final;
  GLFWwindow* window() const { return window_; }
  glm::ivec2 framebufferSizePx() const;
  /// Shows what was drawn; waits for the vertical blank if `interval` is 1.
  void swap(int interval = 1);

 private:
  GLFWwindow* window_ = nullptr;
};

}  // namespace limen::gl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "renderer/gl/context.h"

struct GLFWwindow;

namespace limen::gl {

struct WindowSetting {
  std::string title = "Limen";
  glm::ivec2 sizePx{1024, 768};  ///< unless full screen
  bool visible = true;
  bool fullScreen = false;  ///< in the monitor's current mode, which is not changed
  int monitor = 0;          ///< index into monitors(); full screen only
};

/// A context with its own window (GLFW).
class WindowContext : public Context {
 public:
  /// Throws Error if there is no window system, no OpenGL 4.5 core or no such monitor.
  explicit WindowContext(const WindowSetting& setting);
  WindowContext(const std::string& title, glm::ivec2 sizePx, bool visible = true);
  ~WindowContext() override;

  void makeCurrent() final;
  GLFWwindow* window() const { return window_; }
  glm::ivec2 framebufferSizePx() const;
  /// Framebuffer pixels per window-system unit, the unit of mouse positions.
  glm::vec2 framebufferScale() const;
  bool fullScreen() const;
  /// Of the monitor that shows the window, or most of it, in whole hertz; 0 if unknown.
  double refreshHz() const;
  /// The driver reset the context: nothing drawn since then was shown, nor will be.
  bool contextLost() const;
  /// Minimised, hidden or asked to close: nothing drawn is seen.
  bool hidden() const;
  /// Shows what was drawn; waits for the vertical blank if `interval` is 1.
  void swap(int interval = 1);

 private:
  GLFWwindow* window_ = nullptr;
  int interval_ = -1;  // as it was set last
};

}  // namespace limen::gl

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
  bool fullScreen = false;  ///< in the monitor's present mode, which is left as it is
  int monitor = 0;          ///< index into monitors(); full screen only
};

/// A context with a window of its own (GLFW).
class WindowContext : public Context {
 public:
  /// Throws Error if there is no window system, no OpenGL 4.5 core or no such monitor.
  explicit WindowContext(const WindowSetting& setting);
  WindowContext(const std::string& title, glm::ivec2 sizePx, bool visible = true);
  ~WindowContext() override;

  void makeCurrent() final;
  GLFWwindow* window() const { return window_; }
  glm::ivec2 framebufferSizePx() const;
  /// Framebuffer pixels for each of the window system's units, in which it gives places of the mouse.
  glm::vec2 framebufferScale() const;
  bool fullScreen() const;
  /// Of the monitor that shows the window, or most of it, in whole hertz; 0 if the system does not say.
  double refreshHz() const;
  /// The driver gave the context up: nothing drawn since then was seen, nor will be.
  bool contextLost() const;
  /// Put away, hidden or asked to close: what is drawn is not seen.
  bool hidden() const;
  /// Shows what was drawn; waits for the vertical blank if `interval` is 1.
  void swap(int interval = 1);

 private:
  GLFWwindow* window_ = nullptr;
  int interval_ = -1;  // as it was set last
};

}  // namespace limen::gl

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/gl/window_context.h"
#include "renderer/window/input.h"
#include "renderer/window/ui_surface.h"

namespace limen::window {

struct UiWindowOptions {
  std::string title = "Limen";
  glm::ivec2 sizePx{1024, 768};  ///< unless full screen
  bool fullScreen = false;       ///< in the monitor's current mode, which a study must not change
  int monitor = 0;               ///< index among those connected
  float scale = 0.0F;            ///< of fonts and targets; 0: the monitor's
  bool resizable = false;
  bool takesFocus = true;  ///< when it opens
  UiDensity density = UiDensity::Study;
  UiLettering lettering;
};

/// Where a window is and which monitor shows it.
struct UiMonitor {
  std::string name;
  glm::ivec2 sizePx{0};
  double refreshHz = 0.0;  ///< as reported by the window system, in whole hertz
  float contentScale = 1.0F;
};

/// A window with a graphics context, Dear ImGui and time-stamped input. Knows nothing about its content.
class UiWindow : public UiSurface {
 public:
  /// Throws Error: no window system, no OpenGL 4.5 core, no such monitor.
  explicit UiWindow(const UiWindowOptions& options);
  ~UiWindow() override;

  gl::WindowContext& context() override;
  glm::ivec2 sizePx() const override;
  UiMonitor monitor() const;
  std::string windowSystem() const;  ///< in the window library's wording

  /// Processes window-system events, after waiting at most `seconds` for one.
  void poll(double seconds = 0.0);
  /// Waits at most `seconds` for anything that could change what is shown: mouse, keys, size, wake(). True if
  /// something happened.
  bool waitForAnything(double seconds);
  /// Ends a wait; from any thread.
  static void wake();
  /// What was pressed since the last call, in order.
  std::vector<Input> takeInputs();
  glm::vec2 cursorPx() const;
  bool gamepadPresent() const;
  /// True once after the user closed the window.
  bool takeCloseRequest();
  /// Why what is shown may not be seen (minimised, monitor gone, another size, graphics context lost, behind
  /// other windows), since the last call; "" if nothing happened.
  std::string takeLoss();
  bool contextLost() const;
  void hideCursor(bool hide);

  /// Shows what was drawn and waits until the driver has done so; returns the steady time of that.
  int64_t show(int interval = 1);

 protected:
  void bindContext() const override;
  void beginUiFrame() override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limen::window

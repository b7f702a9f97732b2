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
  bool fullScreen = false;       ///< at the monitor's present mode, which a study must not change
  int monitor = 0;               ///< index among those connected
  float scale = 0.0F;            ///< of fonts and targets; 0: as the monitor asks for
  bool resizable = false;
  bool takesFocus = true;  ///< when it opens
  UiDensity density = UiDensity::Study;
};

/// Where a window is and what shows it.
struct UiMonitor {
  std::string name;
  glm::ivec2 sizePx{0};
  double refreshHz = 0.0;  ///< as the window system says, in whole hertz
  float contentScale = 1.0F;
};

/// A window with a graphics context, Dear ImGui and time-stamped input. Knows nothing of what is shown in it.
class UiWindow : public UiSurface {
 public:
  /// Throws Error: no window system, no OpenGL 4.5 core, no such monitor.
  explicit UiWindow(const UiWindowOptions& options);
  ~UiWindow() override;

  gl::WindowContext& context() override;
  glm::ivec2 sizePx() const override;
  UiMonitor monitor() const;
  std::string windowSystem() const;  ///< as the window library words it

  /// Takes what the window system has, after waiting at most `seconds` for something.
  void poll(double seconds = 0.0);
  /// Waits at most `seconds` for anything that could change what is shown: mouse, keys, size, wake(). True if
  /// something came.
  bool waitForAnything(double seconds);
  /// Ends a wait; from any thread.
  static void wake();
  /// What was pressed since the last call, in order.
  std::vector<Input> takeInputs();
  glm::vec2 cursorPx() const;
  bool gamepadPresent() const;
  /// True once after the user closed the window.
  bool takeCloseRequest();
  /// Why nothing shown now can be relied on to be seen (iconified, monitor gone, another size, graphics
  /// context lost, behind other windows): what happened since the last call, "" if nothing did.
  std::string takeLoss();
  bool contextLost() const;
  void hideCursor(bool hide);

  /// Shows what was drawn and waits until the driver has done so; steady time of that.
  int64_t show(int interval = 1);

 protected:
  void bindContext() const override;
  void beginUiFrame() override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limen::window

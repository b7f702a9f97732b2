// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "study/application/input.h"
#include "study/application/ui_fonts.h"

namespace limen::gl {
class WindowContext;
}

namespace limen::study {

struct UiWindowOptions {
  std::string title = "Limen";
  glm::ivec2 sizePx{1024, 768};  ///< unless full screen
  bool fullScreen = false;       ///< at the monitor's present mode, which a study must not change
  int monitor = 0;               ///< index among those connected
  float scale = 0.0F;            ///< of fonts and targets; 0: as the monitor asks for
  bool resizable = false;
  bool takesFocus = true;  ///< when it opens
};

/// Where a window is and what shows it.
struct UiMonitor {
  std::string name;
  glm::ivec2 sizePx{0};
  double refreshHz = 0.0;  ///< as the window system says, in whole hertz
  float contentScale = 1.0F;
};

/// A window with a graphics context, Dear ImGui and time-stamped input. Knows nothing of what is shown in it.
class UiWindow {
 public:
  /// Throws Error: no window system, no OpenGL 4.5 core, no such monitor.
  explicit UiWindow(const UiWindowOptions& options);
  ~UiWindow();
  UiWindow(const UiWindow&) = delete;
  UiWindow& operator=(const UiWindow&) = delete;

  gl::WindowContext& context();
  glm::ivec2 sizePx() const;  ///< of the framebuffer
  float scale() const;
  const UiFonts& fonts() const;
  UiMonitor monitor() const;
  std::string windowSystem() const;  ///< as the window library words it

  /// Takes what the window system has, after waiting at most `seconds` for something.
  void poll(double seconds = 0.0);
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

  /// Draws an interface over `background` (values as they go to the screen) into the back buffer: `build`
  /// makes its calls to ImGui.
  void draw(glm::vec3 background, const std::function<void()>& build);
  /// The same over what is in the back buffer already.
  void overlay(const std::function<void()>& build);
  /// What was drawn and not yet shown.
  Image readBack() const;
  /// Shows what was drawn and waits until the driver has done so; steady time of that.
  int64_t show(int interval = 1);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace limen::study

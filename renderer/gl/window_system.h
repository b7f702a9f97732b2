// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace limen::gl {

/// A display that is connected.
struct Monitor {
  std::string name;
  glm::ivec2 sizePx{0};    ///< of its present mode
  glm::ivec2 sizeMm{0};    ///< as it says itself, often wrong by a tenth; 0: unknown
  double refreshHz = 0.0;  ///< in whole hertz; 0: the system does not say, as virtual displays do
};

/// All that are connected, the primary one first. Throws Error if there is no window system.
std::vector<Monitor> monitors();

/// What stands between a program and the screen.
struct WindowSystem {
  std::string name;  ///< "X11", "Wayland"
  /// Somebody else puts windows on the screen (every Wayland server, an X11 compositing manager): when a
  /// frame is seen is its choice, if not by more than a frame, unless it lets full-screen windows pass.
  bool compositor = false;
};
/// Throws Error if there is no window system.
WindowSystem windowSystem();

}  // namespace limen::gl

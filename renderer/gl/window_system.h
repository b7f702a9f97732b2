// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace limen::gl {

/// A connected display.
struct Monitor {
  std::string name;
  glm::ivec2 sizePx{0};    ///< of its current mode
  glm::ivec2 sizeMm{0};    ///< as the display reports it, often wrong by a tenth; 0: unknown
  double refreshHz = 0.0;  ///< in whole hertz; 0: unknown, as with virtual displays
};

/// All connected displays, the primary one first. Throws Error if there is no window system.
std::vector<Monitor> monitors();

/// What stands between a program and the screen.
struct WindowSystem {
  std::string name;  ///< "X11", "Wayland"
  /// A compositor puts windows on the screen (every Wayland server, an X11 compositing manager): it decides
  /// when a frame is seen, up to a frame later, unless it lets full-screen windows bypass it.
  bool compositor = false;
};
/// Throws Error if there is no window system.
WindowSystem windowSystem();

}  // namespace limen::gl

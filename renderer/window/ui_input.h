// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <vector>

#include "renderer/window/input.h"

namespace limen::window {

/// Key of a GLFW key event, kKeyNone if it has no meaning here. Letters follow the keyboard layout; the digit
/// row gives digits even if they need shift.
int translateKey(int glfwKey, int scancode);

/// Gamepads have no events: their states are compared at each call.
class GamepadWatch {
 public:
  bool present() const { return present_; }
  /// Appends what was pressed since the last call.
  void poll(std::vector<Input>& inputs);

 private:
  std::map<int, std::vector<bool>> held_;  // joystick -> key held, in the order of the table
  bool present_ = false;
};

}  // namespace limen::window

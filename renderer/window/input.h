// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace limen::window {

enum class Device { Keyboard, Mouse, Gamepad };
const char* toText(Device device);

/// Keys with a meaning, on any device. Printable keys are their lower-case character as
/// the user's keyboard layout has it ('y', '1'); the others follow.
enum Key : int {
  kKeyNone = 0,
  kKeyLeft = 0x1000,
  kKeyRight,
  kKeyUp,
  kKeyDown,
  kKeyEnter,  ///< also the keypad's
  kKeySpace,
  kKeyEscape,
  kKeyBackspace,
  kPadLeft = 0x2000,  ///< directional pad, left stick or left shoulder
  kPadRight,
  kPadUp,
  kPadDown,
  kPadAccept,  ///< lower face button
  kPadBack,    ///< right face button
  kPadStart
};

/// Something that a user pressed, time-stamped when the window system delivered it.
struct Input {
  Device device = Device::Keyboard;
  int key = kKeyNone;      ///< keyboard and gamepad
  float xPx = 0, yPx = 0;  ///< mouse: framebuffer pixels from the upper left corner
  int64_t timeNs = 0;      ///< steady clock
};

/// The clock of all time stamps here.
int64_t steadyNs();

}  // namespace limen::window

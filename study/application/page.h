// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/window/input.h"

namespace limen::study {

/// A large button. Pressed with any of its keys, the mouse, or the accept key while it has the focus.
struct PageButton {
  int id = 0;
  std::string label;
  std::string hint;       ///< names of its keys, shown on it
  std::string padHint;    ///< the same for a gamepad, shown if there is one
  std::vector<int> keys;  ///< Key, of keyboard or gamepad
  bool enabled = true;
};

/// Position in a text that needs more than one page of the screen.
struct TextPages {
  int index = 0, count = 1;
};

/// What is on screen while somebody reads or chooses.
struct Page {
  std::string title;
  std::string text;      ///< paragraphs, read from the left
  std::string question;  ///< large, centred
  std::vector<PageButton> buttons;
  /// Buttons for which space is reserved below the text, so that its pages are the same whichever buttons are
  /// shown.
  std::vector<PageButton> reserved;
  int columns = 0;         ///< of the buttons; 0: all in one row if they fit
  int focus = -1;          ///< button that the accept key would press
  std::string status;      ///< a line above the buttons
  std::string footer;      ///< a line at the bottom
  double progress = -1.0;  ///< 0 to 1, a bar at the bottom; none if negative
  TextPages textPages;
};

/// A button as drawn, in framebuffer pixels.
struct TargetRect {
  int id = 0;
  float x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// The button that an input presses, given the buttons that the user saw; disabled ones are ignored.
std::optional<int> pressedButton(const Page& page, const window::Input& input,
                                 const std::vector<TargetRect>& targets);

/// Focus after an input that moves it (arrows, directional pad), otherwise `page.focus`. From no focus the
/// first step goes to the first button or, backwards, to the last.
int movedFocus(const Page& page, const window::Input& input);

}  // namespace limen::study

// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/page.h"

#include <algorithm>

namespace limen::study {

std::optional<int> pressedButton(const Page& page, const window::Input& input,
                                 const std::vector<TargetRect>& targets) {
  if (input.device == window::Device::Mouse) {
    for (const TargetRect& target : targets) {
      if (input.xPx < target.x0 || input.xPx >= target.x1 || input.yPx < target.y0 || input.yPx >= target.y1)
        continue;
      for (const PageButton& button : page.buttons)
        if (button.id == target.id && button.enabled) return button.id;
    }
    return std::nullopt;
  }
  for (const PageButton& button : page.buttons)
    if (button.enabled && std::count(button.keys.begin(), button.keys.end(), input.key)) return button.id;
  const bool accepts =
      input.key == window::kKeyEnter || input.key == window::kKeySpace || input.key == window::kPadAccept;
  if (accepts && page.focus >= 0 && page.focus < static_cast<int>(page.buttons.size())) {
    const PageButton& button = page.buttons[static_cast<size_t>(page.focus)];
    if (button.enabled) return button.id;
  }
  return std::nullopt;
}

int movedFocus(const Page& page, const window::Input& input) {
  if (input.device == window::Device::Mouse || page.buttons.empty()) return page.focus;
  const int count = static_cast<int>(page.buttons.size());
  const bool forwards = input.key == window::kKeyRight || input.key == window::kPadRight ||
                        input.key == window::kKeyDown || input.key == window::kPadDown;
  const bool backwards = input.key == window::kKeyLeft || input.key == window::kPadLeft ||
                         input.key == window::kKeyUp || input.key == window::kPadUp;
  if (!forwards && !backwards) return page.focus;
  if (page.focus < 0) return forwards ? 0 : count - 1;
  return std::clamp(page.focus + (forwards ? 1 : -1), 0, count - 1);
}

}  // namespace limen::study

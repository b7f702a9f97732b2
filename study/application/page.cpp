// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/page.h"

#include <algorithm>

namespace limen::study {

std::optional<int> pressedButton(const Page& page, const Input& input,
                                 const std::vector<TargetRect>& targets) {
  if (input.device == Device::Mouse) {
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
  const bool accepts = input.key == kKeyEnter || input.key == kKeySpace || input.key == kPadAccept;
  if (accepts && page.focus >= 0 && page.focus < static_cast<int>(page.buttons.size())) {
    const PageButton& button = page.buttons[static_cast<size_t>(page.focus)];
    if (button.enabled) return button.id;
  }
  return std::nullopt;
}

int movedFocus(const Page& page, const Input& input) {
  if (input.device == Device::Mouse || page.buttons.empty()) return page.focus;
  const int count = static_cast<int>(page.buttons.size());
  const bool forwards =
      input.key == kKeyRight || input.key == kPadRight || input.key == kKeyDown || input.key == kPadDown;
  const bool backwards =
      input.key == kKeyLeft || input.key == kPadLeft || input.key == kKeyUp || input.key == kPadUp;
  if (!forwards && !backwards) return page.focus;
  if (page.focus < 0) return forwards ? 0 : count - 1;
  return std::clamp(page.focus + (forwards ? 1 : -1), 0, count - 1);
}

}  // namespace limen::study

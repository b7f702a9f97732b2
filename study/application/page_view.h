// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/window/ui_fonts.h"
#include "study/application/page.h"

namespace limen::study {

/// How pages look in a window.
struct PageStyle {
  window::UiFonts fonts;
  float scale = 1.0F;
  glm::vec3 background{0.25F};  ///< screen values; text is light on dark and dark on light
  bool gamepad = false;         ///< show its keys
};

/// Where things were drawn.
struct PageLayout {
  std::vector<TargetRect> targets;
  int textPages = 1;  ///< that the text needs
  bool fits = true;   ///< false: the window is too small even with text of half the size
};

/// Draws a page with the current ImGui frame over a window of `sizePx`, scaled down if it does not fit. The
/// button under `cursorPx` is highlighted.
PageLayout drawPage(const Page& page, glm::vec2 sizePx, glm::vec2 cursorPx, const PageStyle& style);

}  // namespace limen::study

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "study/application/page.h"
#include "study/application/ui_fonts.h"

namespace limen::study {

/// How pages look in a window.
struct PageStyle {
  UiFonts fonts;
  float scale = 1.0F;
  glm::vec3 background{0.25F};  ///< values of the screen; lettering is light on dark and dark on light
  bool gamepad = false;         ///< show its keys
};

/// Where things were drawn.
struct PageLayout {
  std::vector<TargetRect> targets;
  int textPages = 1;  ///< that the text needs
};

/// Draws a page with the current ImGui frame over a window of `sizePx`. The target under `cursorPx` is lit.
PageLayout drawPage(const Page& page, glm::vec2 sizePx, glm::vec2 cursorPx, const PageStyle& style);

/// A cross in the middle, for eyes to rest on.
void drawFixation(glm::vec2 sizePx, const PageStyle& style);

/// Paragraphs of a text whose lines were wrapped in a file: single line breaks become spaces, empty lines and
/// lists ("- ") stay.
std::string unwrapped(const std::string& text);

}  // namespace limen::study

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

struct ImFont;

namespace limen::study {

struct UiFonts {
  ImFont *body = nullptr, *title = nullptr;
  float bodyPx = 0, titlePx = 0;
  bool arrows = false;  ///< the fonts have arrow signs
  std::string path;     ///< "" for ImGui's own bitmap font
};

/// Fonts for the current ImGui context, made at the size at which they are shown. DejaVu Sans if it is
/// installed (Latin, Greek, Cyrillic, arrows), else ImGui's own (Latin-1).
UiFonts loadUiFonts(float scale);

/// Large targets and high contrast, on a dark ground.
void styleUi(float scale);

}  // namespace limen::study

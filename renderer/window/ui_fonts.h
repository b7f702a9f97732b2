// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

struct ImFont;

namespace limen::window {

/// How an interface is read: at a glance by somebody who was never shown it, or all day by one who knows it.
enum class UiDensity { Study, Workbench };

struct UiFonts {
  ImFont *body = nullptr, *title = nullptr;
  float bodyPx = 0, titlePx = 0;
  bool arrows = false;  ///< the fonts have arrow signs
  std::string path;     ///< "" for ImGui's own bitmap font
};

/// Fonts for the current ImGui context, made at the size at which they are shown. DejaVu Sans if it is
/// installed (Latin, Greek, Cyrillic, arrows), else ImGui's own (Latin-1).
UiFonts loadUiFonts(float scale, UiDensity density = UiDensity::Study);

/// High contrast on a dark ground; large targets in a study, small ones on a workbench.
void styleUi(float scale, UiDensity density = UiDensity::Study);

}  // namespace limen::window

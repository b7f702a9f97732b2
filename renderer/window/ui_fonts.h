// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

struct ImFont;

namespace limen::window {

/// How an interface is read: at a glance by someone new to it, or all day by someone who knows it.
enum class UiDensity { Study, Workbench };

struct UiFonts {
  ImFont *body = nullptr, *title = nullptr;
  float bodyPx = 0, titlePx = 0;
  bool arrows = false;  ///< the fonts have arrow signs
  std::string path;     ///< "" for ImGui's own bitmap font
};

/// Characters beyond those of European languages, and a font file for them; "": one of the system's.
struct UiLettering {
  std::u32string characters;
  std::string fontFile;
};

/// Those of `lettering` that no font here has. Needs neither window nor context. Throws Error if the font
/// file is not one.
std::u32string lackingCharacters(const UiLettering& lettering);

/// Fonts for the current ImGui context, rasterised at display size. DejaVu Sans if it is
/// installed (Latin, Greek, Cyrillic, arrows), otherwise ImGui's own (Latin-1). Further characters come from
/// the given font file, then from the first wide font that is installed: Noto CJK, IPA Gothic, Unifont.
UiFonts loadUiFonts(float scale, UiDensity density = UiDensity::Study, const UiLettering& lettering = {});

/// High contrast on a dark background; large targets in a study, small ones in tools.
void styleUi(float scale, UiDensity density = UiDensity::Study);

}  // namespace limen::window

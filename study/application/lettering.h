// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

struct ImFont;

namespace limen::study {

/// A font at a size.
struct Lettering {
  ImFont* font = nullptr;
  float px = 0.0F;
  float lineHeight() const;
  float width(const std::string& text) const;
};

/// Lines of at most `width` pixels; words that are longer are broken.
std::vector<std::string> wrapped(const Lettering& lettering, const std::string& text, float width);
/// Whether no word of a text needs to be broken.
bool wordsFit(const Lettering& lettering, const std::string& text, float width);
/// Draws lines one below the other, from x or centred on the width, and returns their height. `colour` as
/// ImU32.
float putLines(const Lettering& lettering, const std::vector<std::string>& lines, float x, float y,
               float width, bool centred, uint32_t colour);

/// Paragraphs of a text whose lines were wrapped in a file: single line breaks become spaces, empty lines and
/// lists ("- ") stay.
std::string unwrapped(const std::string& text);

}  // namespace limen::study

// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/lettering.h"

#include <imgui.h>

#include <cmath>
#include <sstream>

namespace limen::study {

float Lettering::lineHeight() const { return std::round(px * 1.35F); }

float Lettering::width(const std::string& text) const {
  return font->CalcTextSizeA(px, 1e9F, 0.0F, text.c_str(), text.c_str() + text.size()).x;
}

std::vector<std::string> wrapped(const Lettering& lettering, const std::string& text, float width) {
  std::vector<std::string> lines;
  std::istringstream paragraphs(text);
  std::string paragraph;
  while (std::getline(paragraphs, paragraph)) {
    const char* from = paragraph.c_str();
    const char* end = from + paragraph.size();
    if (from == end) lines.emplace_back();
    while (from < end) {
      const char* to =
          lettering.font->CalcWordWrapPositionA(lettering.px / lettering.font->FontSize, from, end, width);
      if (to == from) ++to;
      while (to < end && (static_cast<unsigned char>(*to) & 0xC0U) == 0x80U)
        ++to;  // never within a character
      lines.emplace_back(from, to);
      while (to < end && *to == ' ') ++to;
      from = to;
    }
  }
  return lines;
}

bool wordsFit(const Lettering& lettering, const std::string& text, float width) {
  std::istringstream words(text);
  std::string word;
  while (words >> word)
    if (lettering.width(word) > width) return false;
  return true;
}

float putLines(const Lettering& lettering, const std::vector<std::string>& lines, float x, float y,
               float width, bool centred, uint32_t colour) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  float at = y;
  for (const std::string& line : lines) {
    const float left = centred ? x + (width - lettering.width(line)) / 2 : x;
    list.AddText(lettering.font, lettering.px, {std::round(left), std::round(at)}, colour, line.c_str(),
                 line.c_str() + line.size());
    at += lettering.lineHeight();
  }
  return at - y;
}

std::string unwrapped(const std::string& text) {
  std::string out;
  std::istringstream lines(text);
  std::string line;
  bool open = false;  // a paragraph has begun
  while (std::getline(lines, line)) {
    while (!line.empty() && (line.back() == ' ' || line.back() == '\r')) line.pop_back();
    const bool item = line.rfind("- ", 0) == 0;
    if (line.empty()) {
      if (open) out += "\n\n";
      open = false;
      continue;
    }
    if (open) out += item ? "\n" : " ";
    out += line;
    open = true;
  }
  while (!out.empty() && out.back() == '\n') out.pop_back();
  return out;
}

}  // namespace limen::study

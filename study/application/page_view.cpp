// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/page_view.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace limen::study {
namespace {

// Longer lines are hard to follow back: 36 times the size are 70 characters or so.
constexpr float kTextWidthEm = 36.0F;

ImU32 colour(glm::vec3 value, float alpha = 1.0F) {
  return ImGui::ColorConvertFloat4ToU32({value.x, value.y, value.z, alpha});
}

struct Palette {
  glm::vec3 text, dim, button, lit, border;
};

Palette paletteFor(glm::vec3 background) {
  const float level = (background.x + background.y + background.z) / 3.0F;
  const bool dark = level < 0.5F;
  const auto towards = [&](float share) {
    return glm::mix(background, glm::vec3(dark ? 1.0F : 0.0F), share);
  };
  return {towards(0.92F), towards(0.55F), towards(0.10F), towards(0.22F), towards(0.45F)};
}

struct Lettering {
  ImFont* font;
  float px;
  float lineHeight() const { return std::round(px * 1.35F); }
  float width(const std::string& text) const {
    return font->CalcTextSizeA(px, 1e9F, 0.0F, text.c_str(), text.c_str() + text.size()).x;
  }
};

// Lines of at most `width`; words that are longer are broken.
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

// Draws lines one below the other and returns the height.
float putLines(const Lettering& lettering, const std::vector<std::string>& lines, float x, float y,
               float width, bool centred, glm::vec3 value) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  float at = y;
  for (const std::string& line : lines) {
    const float left = centred ? x + (width - lettering.width(line)) / 2 : x;
    list.AddText(lettering.font, lettering.px, {std::round(left), std::round(at)}, colour(value),
                 line.c_str(), line.c_str() + line.size());
    at += lettering.lineHeight();
  }
  return at - y;
}

// Sizes of the buttons' grid, alike for all of them.
struct ButtonGrid {
  int columns = 1, rows = 1;
  float width = 0, height = 0, gap = 0;
  float totalHeight() const { return static_cast<float>(rows) * (height + gap) - gap; }
};

std::string hintOf(const PageButton& button, const PageStyle& style) {
  std::string hint = button.hint;
  if (!style.fonts.arrows) {
    for (const auto& [sign, word] : {std::pair{"\u2190", "left arrow"}, std::pair{"\u2192", "right arrow"}})
      if (const size_t at = hint.find(sign); at != std::string::npos) hint.replace(at, 3, word);
  }
  if (style.gamepad && !button.padHint.empty()) hint += (hint.empty() ? "" : " / ") + button.padHint;
  return hint;
}

ButtonGrid gridFor(const std::vector<PageButton>& buttons, int columns, float available,
                   const Lettering& body, float scale) {
  ButtonGrid grid;
  grid.gap = 20 * scale;
  const int count = static_cast<int>(buttons.size());
  const float padding = 18 * scale;
  for (grid.columns = columns > 0 ? columns : count; grid.columns > 1; --grid.columns) {
    grid.width =
        (available - static_cast<float>(grid.columns - 1) * grid.gap) / static_cast<float>(grid.columns);
    const bool fit = std::all_of(buttons.begin(), buttons.end(), [&](const PageButton& button) {
      return wordsFit(body, button.label, grid.width - 2 * padding) &&
             wrapped(body, button.label, grid.width - 2 * padding).size() <= 3;
    });
    if (fit) break;
  }
  grid.rows = (count + grid.columns - 1) / grid.columns;
  const float widest = (count <= 3 ? 340.0F : 260.0F) * scale;
  grid.width = std::min(
      (available - static_cast<float>(grid.columns - 1) * grid.gap) / static_cast<float>(grid.columns),
      widest);
  size_t lines = 1;
  bool hints = false;
  for (const PageButton& button : buttons) {
    lines = std::max(lines, wrapped(body, button.label, grid.width - 2 * padding).size());
    hints |= !button.hint.empty();
  }
  grid.height =
      std::max(body.lineHeight() * static_cast<float>(lines + (hints ? 1 : 0)) + 1.4F * padding, 84 * scale);
  return grid;
}

void drawButton(const PageButton& button, const TargetRect& rect, bool focused, bool lit,
                const Lettering& body, const PageStyle& style, const Palette& palette) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const float rounding = 8 * style.scale;
  const ImVec2 low(rect.x0, rect.y0), high(rect.x1, rect.y1);
  if (button.enabled)
    list.AddRectFilled(low, high, colour(lit || focused ? palette.lit : palette.button), rounding);
  list.AddRect(low, high, colour(focused ? palette.text : palette.border, button.enabled ? 1.0F : 0.4F),
               rounding, 0, (focused ? 4.0F : 2.0F) * style.scale);
  const float padding = 18 * style.scale, width = rect.x1 - rect.x0;
  const std::vector<std::string> lines = wrapped(body, button.label, width - 2 * padding);
  const std::string hint = hintOf(button, style);
  const Lettering small{body.font, std::round(body.px * 0.8F)};
  const float height =
      body.lineHeight() * static_cast<float>(lines.size()) + (hint.empty() ? 0 : small.lineHeight());
  const float y = (rect.y0 + rect.y1 - height) / 2;
  const float used =
      putLines(body, lines, rect.x0, y, width, true, button.enabled ? palette.text : palette.dim);
  if (!hint.empty()) putLines(small, {hint}, rect.x0, y + used, width, true, palette.dim);
}

// Rows are centred, the last one too.
std::vector<TargetRect> placeButtons(const Page& page, const ButtonGrid& grid, glm::vec2 sizePx, float top) {
  std::vector<TargetRect> rects;
  const int count = static_cast<int>(page.buttons.size());
  for (int i = 0; i < count; ++i) {
    const int row = i / grid.columns, inRow = std::min(grid.columns, count - row * grid.columns);
    const float rowWidth = static_cast<float>(inRow) * (grid.width + grid.gap) - grid.gap;
    const float x = std::round((sizePx.x - rowWidth) / 2 +
                               static_cast<float>(i % grid.columns) * (grid.width + grid.gap));
    const float y = std::round(top + static_cast<float>(row) * (grid.height + grid.gap));
    rects.push_back({page.buttons[static_cast<size_t>(i)].id, x, y, x + grid.width, y + grid.height});
  }
  return rects;
}

// The line at the bottom with the bar above it; returns the height that it takes.
float drawFooter(const Page& page, glm::vec2 sizePx, const PageStyle& style, const Palette& palette) {
  if (page.footer.empty() && page.progress < 0) return 0;
  const Lettering small{style.fonts.body, std::round(style.fonts.bodyPx * 0.8F)};
  const float margin = 24 * style.scale;
  float y = sizePx.y - margin;
  if (!page.footer.empty()) {
    y -= small.lineHeight();
    putLines(small, {page.footer}, 0, y, sizePx.x, true, palette.dim);
  }
  if (page.progress >= 0) {
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float width = std::min(sizePx.x * 0.5F, 480 * style.scale), height = 12 * style.scale;
    y -= height + 8 * style.scale;
    const float x = (sizePx.x - width) / 2;
    list.AddRectFilled({x, y}, {x + width, y + height}, colour(palette.button), height / 2);
    list.AddRectFilled(
        {x, y}, {x + std::max(width * static_cast<float>(std::min(page.progress, 1.0)), height), y + height},
        colour(palette.dim), height / 2);
  }
  return sizePx.y - y;
}

}  // namespace

PageLayout drawPage(const Page& page, glm::vec2 sizePx, glm::vec2 cursorPx, const PageStyle& style) {
  const Palette palette = paletteFor(style.background);
  const Lettering body{style.fonts.body, style.fonts.bodyPx}, title{style.fonts.title, style.fonts.titlePx};
  const float margin = std::min(48 * style.scale, 0.06F * sizePx.x);
  const float available = sizePx.x - 2 * margin;
  const float textWidth = std::min(available, kTextWidthEm * body.px);
  const float textX = std::round((sizePx.x - textWidth) / 2);
  const float footer = drawFooter(page, sizePx, style, palette);

  const ButtonGrid grid = gridFor(page.buttons, page.columns, available, body, style.scale);
  const float bottom = sizePx.y - std::max(footer + 24 * style.scale, margin);
  float buttonsTop = bottom - (page.buttons.empty() ? 0 : grid.totalHeight());
  const float statusHeight = page.status.empty() ? 0 : body.lineHeight() + 12 * style.scale;

  float y = margin;
  if (!page.title.empty())
    y += putLines(title, wrapped(title, page.title, textWidth), textX, y, textWidth, false, palette.text) +
         16 * style.scale;

  const std::vector<std::string> question = wrapped(title, page.question, available);
  const float questionHeight =
      page.question.empty() ? 0 : title.lineHeight() * static_cast<float>(question.size());
  // A question stands with its buttons in the middle, where the eyes are; a text leaves the buttons below.
  if (!page.question.empty()) {
    const float gap = 40 * style.scale;
    const float block = questionHeight + gap + (bottom - buttonsTop);
    const float top = std::max((sizePx.y - block) / 2, margin);
    buttonsTop = std::min(top + questionHeight + gap, buttonsTop);
    putLines(title, question, margin, buttonsTop - gap - questionHeight, available, true, palette.text);
  }

  PageLayout layout;
  if (!page.text.empty()) {
    float textBottom = buttonsTop - 24 * style.scale;
    if (!page.question.empty()) textBottom -= questionHeight + 40 * style.scale;
    if (!page.reserved.empty()) {
      const ButtonGrid reserved = gridFor(page.reserved, 0, available, body, style.scale);
      textBottom = bottom - reserved.totalHeight() - body.lineHeight() - 36 * style.scale;
    }
    const std::vector<std::string> lines = wrapped(body, unwrapped(page.text), textWidth);
    const auto pageLines = static_cast<size_t>(std::max((textBottom - y) / body.lineHeight(), 1.0F));
    layout.textPages = static_cast<int>((lines.size() + pageLines - 1) / pageLines);
    const size_t first =
        std::min(static_cast<size_t>(std::max(page.textPages.index, 0)) * pageLines, lines.size());
    const size_t last = std::min(first + pageLines, lines.size());
    putLines(body,
             {lines.begin() + static_cast<std::ptrdiff_t>(first),
              lines.begin() + static_cast<std::ptrdiff_t>(last)},
             textX, y, textWidth, false, palette.text);
  }
  if (!page.status.empty())
    putLines(body, {page.status}, 0, buttonsTop - statusHeight, sizePx.x, true, palette.dim);

  layout.targets = placeButtons(page, grid, sizePx, buttonsTop);
  for (size_t i = 0; i < layout.targets.size(); ++i) {
    const TargetRect& rect = layout.targets[i];
    const bool lit =
        cursorPx.x >= rect.x0 && cursorPx.x < rect.x1 && cursorPx.y >= rect.y0 && cursorPx.y < rect.y1;
    drawButton(page.buttons[i], rect, page.focus == static_cast<int>(i), lit, body, style, palette);
  }
  return layout;
}

void drawFixation(glm::vec2 sizePx, const PageStyle& style) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImU32 value = colour(paletteFor(style.background).dim);
  const glm::vec2 middle = glm::round(sizePx / 2.0F);
  const float arm = std::round(14 * style.scale), half = std::max(std::round(1.5F * style.scale), 1.0F);
  list.AddRectFilled({middle.x - arm, middle.y - half}, {middle.x + arm, middle.y + half}, value);
  list.AddRectFilled({middle.x - half, middle.y - arm}, {middle.x + half, middle.y + arm}, value);
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

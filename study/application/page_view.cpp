// SPDX-License-Identifier: BSD-3-Clause
#include "study/application/page_view.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "study/application/lettering.h"

namespace limen::study {
namespace {

// Longer lines are hard to read: 36 times the size is about 70 characters.
constexpr float kTextWidthEm = 36.0F;
// Sizes tried in turn until a page fits.
constexpr std::array<float, 6> kShares = {1.0F, 0.9F, 0.8F, 0.7F, 0.6F, 0.5F};

ImU32 colour(glm::vec3 value) { return ImGui::ColorConvertFloat4ToU32({value.x, value.y, value.z, 1.0F}); }

struct Palette {
  ImU32 text, dim, button, lit, border, faint;
};

Palette paletteFor(glm::vec3 background) {
  const float level = (background.x + background.y + background.z) / 3.0F;
  const bool dark = level < 0.5F;
  const auto towards = [&](float share) {
    return colour(glm::mix(background, glm::vec3(dark ? 1.0F : 0.0F), share));
  };
  return {towards(0.92F), towards(0.70F), towards(0.10F), towards(0.22F), towards(0.45F), towards(0.20F)};
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
  if (buttons.empty()) return grid;
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
  if (button.enabled) list.AddRectFilled(low, high, lit || focused ? palette.lit : palette.button, rounding);
  list.AddRect(low, high,
               !button.enabled ? palette.faint
               : focused       ? palette.text
                               : palette.border,
               rounding, 0, (focused ? 4.0F : 2.0F) * style.scale);
  const float padding = 18 * style.scale, width = rect.x1 - rect.x0;
  const std::vector<std::string> lines = wrapped(body, button.label, width - 2 * padding);
  const std::string hint = hintOf(button, style);
  const Lettering small{body.font, std::round(body.px * 0.85F)};
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
    list.AddRectFilled({x, y}, {x + width, y + height}, palette.button, height / 2);
    if (page.progress > 0)
      list.AddRectFilled(
          {x, y},
          {x + std::max(width * static_cast<float>(std::min(page.progress, 1.0)), height), y + height},
          palette.dim, height / 2);
  }
  return sizePx.y - y;
}

// The layout with text scaled by a given factor.
struct Arrangement {
  Lettering body, title;
  float titleTop = 0, questionTop = 0, textTop = 0, statusTop = 0, buttonsTop = 0;
  float left = 0, width = 0;  // of the text
  std::vector<std::string> titleLines, questionLines, textLines;
  size_t linesAPage = 0;
  ButtonGrid grid;
  bool fits = true;
};

Arrangement arrange(const Page& page, glm::vec2 sizePx, float footer, const PageStyle& style, float share) {
  Arrangement at;
  at.body = {style.fonts.body, std::round(style.fonts.bodyPx * share)};
  at.title = {style.fonts.title, std::round(style.fonts.titlePx * share)};
  const float scale = style.scale * share;
  const float margin = std::min(48 * scale, 0.06F * sizePx.x), available = sizePx.x - 2 * margin;
  at.width = std::min(available, kTextWidthEm * at.body.px);
  at.left = std::round((sizePx.x - at.width) / 2);
  at.grid = gridFor(page.buttons, page.columns, available, at.body, scale);
  const float buttons = page.buttons.empty() ? 0 : at.grid.totalHeight();
  const float bottom = sizePx.y - std::max(footer + 24 * scale, margin);
  const float status = at.body.lineHeight() + 12 * scale;

  at.titleTop = margin;
  at.titleLines = wrapped(at.title, page.title, at.width);
  at.textTop = at.titleTop;
  if (!page.title.empty())
    at.textTop += at.title.lineHeight() * static_cast<float>(at.titleLines.size()) + 16 * scale;
  at.textLines = wrapped(at.body, unwrapped(page.text), at.width);
  const float text = at.body.lineHeight() * static_cast<float>(at.textLines.size());

  at.buttonsTop = bottom - buttons;
  float textBottom = at.buttonsTop - (page.status.empty() ? 0 : status) - 24 * scale;
  if (!page.reserved.empty())
    textBottom =
        bottom - gridFor(page.reserved, 0, available, at.body, scale).totalHeight() - status - 24 * scale;
  if (!page.question.empty()) {
    // A question is in the middle with its buttons, where the eyes are; a text has the buttons below.
    at.questionLines = wrapped(at.title, page.question, available);
    const float question = at.title.lineHeight() * static_cast<float>(at.questionLines.size());
    const float gap = 40 * scale, block = question + gap + buttons;
    const float top = at.textTop + (page.text.empty() ? 0 : text + 24 * scale);
    at.questionTop = std::max((sizePx.y - block) / 2, top);
    at.buttonsTop = at.questionTop + question + gap;
    at.fits = at.buttonsTop + buttons <= bottom;
    textBottom = at.questionTop;
  }
  at.statusTop = at.buttonsTop - status;
  at.linesAPage = static_cast<size_t>(std::max((textBottom - at.textTop) / at.body.lineHeight(), 1.0F));
  // A page without page turning must fit completely; with it, a few lines per page are needed to be readable.
  const size_t needed =
      page.reserved.empty() ? at.textLines.size() : std::min<size_t>(at.textLines.size(), 4);
  at.fits = at.fits && at.linesAPage >= needed && at.buttonsTop >= at.textTop;
  return at;
}

}  // namespace

PageLayout drawPage(const Page& page, glm::vec2 sizePx, glm::vec2 cursorPx, const PageStyle& style) {
  const Palette palette = paletteFor(style.background);
  const float footer = drawFooter(page, sizePx, style, palette);
  Arrangement at;
  for (const float share : kShares) {
    at = arrange(page, sizePx, footer, style, share);
    if (at.fits) break;
  }
  putLines(at.title, at.titleLines, at.left, at.titleTop, at.width, false, palette.text);
  putLines(at.title, at.questionLines, 0, at.questionTop, sizePx.x, true, palette.text);

  PageLayout layout;
  layout.fits = at.fits;
  const size_t lines = at.textLines.size();
  layout.textPages = static_cast<int>(std::max<size_t>((lines + at.linesAPage - 1) / at.linesAPage, 1));
  const auto first = std::min(static_cast<size_t>(page.textPages.index) * at.linesAPage, lines);
  const auto last = std::min(first + at.linesAPage, lines);
  using Step = std::vector<std::string>::difference_type;
  putLines(at.body,
           {at.textLines.begin() + static_cast<Step>(first), at.textLines.begin() + static_cast<Step>(last)},
           at.left, at.textTop, at.width, false, palette.text);
  if (!page.status.empty()) putLines(at.body, {page.status}, 0, at.statusTop, sizePx.x, true, palette.dim);

  layout.targets = placeButtons(page, at.grid, sizePx, at.buttonsTop);
  for (size_t i = 0; i < layout.targets.size(); ++i) {
    const TargetRect& rect = layout.targets[i];
    const bool lit =
        cursorPx.x >= rect.x0 && cursorPx.x < rect.x1 && cursorPx.y >= rect.y0 && cursorPx.y < rect.y1;
    drawButton(page.buttons[i], rect, page.focus == static_cast<int>(i), lit, at.body, style, palette);
  }
  return layout;
}

}  // namespace limen::study

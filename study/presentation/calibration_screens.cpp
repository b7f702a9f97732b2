// SPDX-License-Identifier: BSD-3-Clause
#include "study/presentation/calibration_screens.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "study/presentation/calibration.h"

namespace limen::study {
namespace {

/// Asks until a key ends it. `draw` gets the value.
std::optional<double> adjust(ScreenDevice& screen, double value, double step, double low, double high,
                             const std::function<void(double)>& draw) {
  while (true) {
    draw(value);
    screen.swap();
    if (screen.lost()) return std::nullopt;
    for (const ScreenEvent& event : screen.poll()) {
      if (event.kind == ScreenEvent::Kind::Close || event.name == "escape") return std::nullopt;
      if (event.name == "enter") return value;
      const double steps = event.name == "right"  ? 1.0
                           : event.name == "left" ? -1.0
                           : event.name == "up"   ? 10.0
                           : event.name == "down" ? -10.0
                                                  : 0.0;
      value = std::clamp(value + steps * step, low, high);
    }
  }
}

}  // namespace

std::optional<double> adjustCardWidth(ScreenDevice& screen, double startPx) {
  constexpr int kLinePx = 2;
  const glm::ivec2 screenPx = screen.sizePx();
  const double widest = std::min(double(screenPx.x), screenPx.y * kCardWidthM / kCardHeightM) - 2.0 * kLinePx;
  return adjust(screen, std::round(std::clamp(startPx, 20.0, widest)), 1.0, 20.0, widest,
                [&](double widthPx) {
                  const glm::ivec2 size(static_cast<int>(widthPx),
                                        static_cast<int>(std::lround(widthPx * kCardHeightM / kCardWidthM)));
                  const glm::ivec2 low = (screenPx - size) / 2, high = low + size;
                  screen.clear(0.2);
                  // The lines are outside: the card covers what they enclose.
                  screen.fill(low - kLinePx, {size.x + 2 * kLinePx, kLinePx}, 1.0);
                  screen.fill({low.x - kLinePx, high.y}, {size.x + 2 * kLinePx, kLinePx}, 1.0);
                  screen.fill({low.x - kLinePx, low.y}, {kLinePx, size.y}, 1.0);
                  screen.fill({high.x, low.y}, {kLinePx, size.y}, 1.0);
                });
}

std::optional<double> adjustMatch(ScreenDevice& screen, double proportion, double startLevel) {
  const glm::ivec2 screenPx = screen.sizePx();
  const int field = std::min(screenPx.x, screenPx.y) / 2 / 8 * 8, square = field / 2;
  const glm::ivec2 low = (screenPx - field) / 2, inner = (screenPx - square) / 2;
  // Of four rows one, the first and third, or three are white.
  const auto white = [&](int row) { return proportion == 0.5 ? row % 2 == 0 : row % 4 < 4.0 * proportion; };
  constexpr double kCode = 1.0 / 255.0;
  const double start = std::round(startLevel / kCode) * kCode;
  return adjust(screen, start, kCode, kCode, 1.0 - kCode, [&](double level) {
    screen.clear(0.0);
    for (int row = 0; row < field; ++row)
      if (white(row)) screen.fill({low.x, low.y + row}, {field, 1}, 1.0);
    screen.fill(inner, {square, square}, level);
  });
}

}  // namespace limen::study

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace limen::study {

/// A picture ready to be drawn: layer of an RGBA8 array texture (its OpenGL name; any number on a screen
/// without OpenGL), values as sent to the display.
struct Picture {
  uint32_t texture = 0;
  int layer = 0;
  bool operator==(const Picture&) const = default;
};

/// User input at a screen.
struct ScreenEvent {
  enum class Kind {
    Key,    ///< `name` in the keyboard layout: "y", "1", "space", "escape", "left" ...
    Mouse,  ///< `name`: "left", "middle", "right"
    Close   ///< the window should close
  } kind = Kind::Key;
  std::string name;
  glm::dvec2 atPx{0.0};  ///< Mouse: where, from the screen's upper left corner
  int64_t timeNs = 0;    ///< steady clock when the program heard of it
};

/// Something that shows frames at vertical blanks. Positions are in px of the screen from its upper left
/// corner; `light` is linear, 1 the display's white. Draw calls make the next frame, swap() shows it.
class ScreenDevice {
 public:
  virtual ~ScreenDevice() = default;
  virtual double refreshHz() const = 0;  ///< nominal; 0 if unknown
  virtual glm::ivec2 sizePx() const = 0;

  virtual void clear(double light) = 0;
  /// Pixel for pixel, unscaled.
  virtual void draw(const Picture& picture, glm::ivec2 topLeftPx, glm::ivec2 sizePx) = 0;
  virtual void fill(glm::ivec2 topLeftPx, glm::ivec2 sizePx, double light) = 0;
  virtual void ring(glm::dvec2 centrePx, double radiusPx, double widthPx, double light) = 0;
  /// Points down at `tipPx`.
  virtual void arrow(glm::dvec2 tipPx, double lengthPx, double light) = 0;

  /// Shows the frame at the next vertical blank and waits for it. Returns the steady clock's time [ns] then.
  virtual int64_t swap() = 0;
  /// The window was hidden or closed, or the graphics driver reset: what was drawn was not seen.
  virtual bool lost() const = 0;
  /// What happened since the last call; does not wait.
  virtual std::vector<ScreenEvent> poll() = 0;
};

}  // namespace limen::study

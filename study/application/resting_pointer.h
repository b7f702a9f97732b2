// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>

namespace limen::study {

/// A pointer that lies where somebody left it: neither highlighted nor clicked answers come of it until it
/// has been moved.
class RestingPointer {
 public:
  RestingPointer() = default;
  /// `ignored`: until it has moved away from `at` (framebuffer pixels).
  RestingPointer(glm::vec2 at, bool ignored) : at_(at), ignored_(ignored) {}
  /// Whether it counts now that it is at `now`; once it does, it goes on doing so.
  bool counts(glm::vec2 now) {
    if (ignored_ && glm::distance(now, at_) > kMovedPx) ignored_ = false;
    return !ignored_;
  }

 private:
  /// A hand that presses a button moves the mouse by a pixel or two.
  static constexpr float kMovedPx = 4.0F;
  glm::vec2 at_{0};
  bool ignored_ = false;
};

}  // namespace limen::study

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "renderer/frame/frame.h"

namespace limen::techniques {

/// A view of the parent's scene with its own levels; nothing is uploaded while they stay the same.
class LevelView {
 public:
  LevelView(frame::Frame& parent, const std::string& name) : frame_(parent, name, parent.sizePx()) {}
  frame::Frame& show(double timeS, const scene::LodSelection& selection) {
    frame_.setTime(timeS);
    if (shown_ != selection) frame_.setLevels(*(shown_ = selection));
    frame_.begin();
    return frame_;
  }
  frame::Frame& frame() { return frame_; }

 private:
  frame::Frame frame_;
  std::optional<scene::LodSelection> shown_;
};

/// Rectangle of pixels, `high` excluded.
struct PixelRect {
  glm::ivec2 low{0}, high{0};
  bool empty() const { return low.x >= high.x || low.y >= high.y; }
};
/// All pixels in which something within `bounds` may be seen.
PixelRect pixelsOf(const scene::Bounds& bounds, const frame::Frame& frame);

/// No object, no background.
scene::LodSelection nothingOf(const scene::Scene& scene);
/// A single object.
scene::LodSelection onlyObject(const scene::Scene& scene, int object, int level);

}  // namespace limen::techniques

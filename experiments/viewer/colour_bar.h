// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <imgui.h>

#include <glm/glm.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "experiments/viewer/ui_texture.h"

namespace limen::viewer {

/// What the colours of a map mean: a strip of them, dark to bright, and values at shares of its length.
struct ColourScale {
  std::shared_ptr<const ScreenPicture> strip;
  std::vector<std::pair<float, std::string>> ticks;
  std::string title;  ///< quantity and unit

  bool operator==(const ColourScale&) const = default;
};

/// Of perception::errorPicture() up to `white`. `largest`: of the map; the last value says where brighter
/// ones lie beyond the scale.
ColourScale errorScaleOf(const std::string& title, double white, double largest);
/// Of perception::thresholdPicture().
ColourScale thresholdScale(const std::string& title = "threshold (cd/m2)");

/// A scale drawn below a picture.
class ColourBar {
 public:
  static float heightPx() { return 2.6F * ImGui::GetFontSize(); }
  /// Within a rectangle heightPx() high.
  void draw(const ColourScale& scale, glm::vec2 leastPx, glm::vec2 mostPx);

 private:
  UiTexture strip_;
};

}  // namespace limen::viewer

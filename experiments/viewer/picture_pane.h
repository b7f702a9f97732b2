// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "experiments/viewer/colour_bar.h"
#include "experiments/viewer/pane.h"
#include "experiments/viewer/ui_texture.h"

namespace limen::viewer {

/// The picture or pictures as arranged, and the mouse on them: camera, picked pixel, split.
class PicturePane {
 public:
  void build(const PaneContext& pane, glm::vec2 leastPx, glm::vec2 mostPx, double secondsPassed);

 private:
  struct Placed {
    glm::vec2 leastPx, mostPx;
  };
  void arrangementBar(const PaneContext& pane);
  void zoomControl(const ViewerState& state);
  float factorFor(glm::ivec2 sizePx, glm::vec2 roomPx) const;
  void upload(const ViewerState& state);
  /// Of the picture shown, if it is a map of values.
  std::optional<ColourScale> scaleOf(const ViewerState& state) const;
  Placed drawArranged(const ViewerState& state, glm::vec2 leastPx, glm::vec2 mostPx);
  Placed place(const UiTexture& texture, glm::vec2 leastPx, glm::vec2 mostPx) const;
  /// The part of the picture from `fromX` to `toX`, shares of its width.
  void draw(const UiTexture& texture, const Placed& where, float fromX, float toX, const std::string& name);
  std::string textIfEmpty(const ViewerState& state) const;
  const UiTexture& shownTexture(Arrangement arrangement) const;
  void handleMouse(const PaneContext& pane, const Placed& where, double secondsPassed);
  void moveCamera(const PaneContext& pane, const Placed& where, double secondsPassed);
  void pick(const PaneContext& pane, const Placed& where);
  void markPicked(const ViewerState& state, const Placed& where) const;

  UiTexture first_, second_, errorMap_, prediction_;
  double flickerHz_ = 2.0, clockS_ = 0.0;
  float splitAt_ = 0.5F;      // share of the width
  int zoom_ = 0;              // screen pixels for one of the picture; 0: as many as fit
  float shownFactor_ = 1.0F;  // in the last frame
  ColourBar colourBar_;
  glm::vec2 panPx_{0.0F};

  // A drag in the picture.
  scene::Camera dragFrom_;
  glm::vec2 dragStartPx_{0.0F}, panFrom_{0.0F};
  bool splitHeld_ = false;
};

}  // namespace limen::viewer

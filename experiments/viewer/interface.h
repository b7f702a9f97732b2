// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/viewer/camera_pane.h"
#include "experiments/viewer/pane.h"
#include "experiments/viewer/picture_pane.h"

namespace limen::viewer {

/// The viewer's interface: what is rendered on the left, the picture in the middle, what was measured on the
/// right, messages below. Its only state is that of its widgets (a drag, typed text, the zoom).
class Interface {
 public:
  /// One frame, in calls to ImGui, on a surface of `sizePx` with text of `emPx`.
  void build(const PaneContext& pane, glm::vec2 sizePx, float emPx, double secondsPassed);

 private:
  CameraPane camera_;
  PicturePane picture_;
};

/// The keys that work wherever no text is typed.
void handleKeys(const PaneContext& pane);

}  // namespace limen::viewer

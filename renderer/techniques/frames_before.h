// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "experiments/base/settings_table.h"
#include "renderer/frame/frame.h"
#include "renderer/scene/scene.h"

namespace limen::techniques {

/// The scene with its first light, which must be there, turned about the scene's middle and the vertical.
scene::Scene withLightTurned(const scene::Scene& scene, double degrees);

/// Frames that a technique which carries something from frame to frame renders before its first picture.
struct FramesBefore {
  int frames = 0, settled = 0;
  double stepS = 1.0 / 60.0;
  double lightTurnDeg = 0.0;
  static const SettingsTable<FramesBefore>& table();

  /// Calls `render` for each of them, begun, with the camera, parts and first light of its time. At their end
  /// the frame has its own time again and is not begun.
  void renderAll(frame::Frame& frame, const std::function<void(frame::Frame&)>& render) const;
};

}  // namespace limen::techniques

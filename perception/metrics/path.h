// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>

#include "experiments/base/settings_table.h"
#include "perception/metrics/metric.h"

namespace limen::perception {

/// The light moves in its plane.
struct LightPath {
  static constexpr const char *kKind = "light", *kSummary = "the light moves in its plane";
  double step = 0.05;         ///< from frame to frame, as a share of the light's extents
  double directionDeg = 0.0;  ///< from the light's x axis to its y axis
  static const SettingsTable<LightPath>& table();
};
/// The camera moves on the scene's path.
struct CameraPath {
  static constexpr const char *kKind = "camera",
                              *kSummary = "time passes: the camera moves on its path, and parts as they do";
  double stepS = 1.0 / 60.0;  ///< time from frame to frame
  static const SettingsTable<CameraPath>& table();
};

/// A sequence of frames that starts with the run's own.
struct PathRequest {
  std::variant<LightPath, CameraPath> path;
  int steps = 4;  ///< from frame to frame; one frame more than steps
  static const SettingsTable<PathRequest>& table();
};

/// One frame of a path, on the GPU. Valid during the visit.
struct PathFrame {
  const gl::Texture* test = nullptr;  ///< as in ComparisonInput
  const gl::Texture* reference = nullptr;
  const gl::Texture* mask = nullptr;  ///< R32F as in ComparisonInput; null: everywhere
  LitSurfaces surfaces;
  /// The camera's motion since the frame before (frame::Motion); null: it rests.
  const gl::Texture* displacement = nullptr;  ///< RG32F, px
  const gl::Texture* depthBefore = nullptr;   ///< R32F: distance of each pixel's point in the frame before
  const gl::Texture* depth = nullptr;         ///< R32F: of this frame's points; 0: background
};

}  // namespace limen::perception

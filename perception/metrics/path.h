// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/settings_table.h"
#include "perception/metrics/metric.h"

namespace limen::perception {

/// A sequence of frames that starts with the run's own.
struct PathRequest {
  int steps = 8;              ///< from frame to frame; the first frame is the run's own
  double cameraStepS = 0.0;   ///< time that the camera advances on its path
  double lightStep = 0.0;     ///< way of the light in its plane, as a share of its extents
  double directionDeg = 0.0;  ///< of the light's way, from its x axis to its y axis
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

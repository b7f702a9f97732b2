// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/image.h"
#include "perception/popping/weight_settings.h"

/// Weight maps that tell the predictor where a difference is less likely to be noticed. Schwarz 2009, section
/// 10.3.5.
namespace limen::perception {

/// One level of detail's part in the disocclusion weight.
struct DisocclusionView {
  /// Depth that each pixel's surface point of the current frame had in the previous frame's camera: 1
  /// channel, linear depth (distance along the view axis), > 0; <= 0: background.
  Image previousDepthOfPixel;
  /// Displacement of each pixel against the previous frame, pixels: previous position = centre -
  /// displacement.
  Image displacement;
  /// Depth map of this level of detail in the previous frame's setting, linear depth; <= 0: background.
  Image previousDepth;
};

/// Visibility in the previous frame, in [0, 1]: percentage-closer comparison over (2 r + 1)^2 bilinear taps,
/// the largest over all views. A position outside the frame has visibility settings.outsideVisibility.
Image disocclusionWeight(const std::vector<DisocclusionView>& views,
                         const DisocclusionSettings& settings = {});

struct FlickerInput {
  Image actual, predicted;  ///< current frame, new and old level of detail; linear RGB
  Image previousShading;    ///< each pixel's surface shaded in the previous frame's setting; linear RGB
  Image previousFrame;      ///< previous frame; linear RGB
  Image displacement;       ///< pixels per frame
  Image previousDepthOfPixel, previousDepth;  ///< as above; both empty: depth is not compared
};

/// settings.weight where shading changes over time as much as between the levels of detail,
/// dE94(previous frame at the pixel's previous position, previous shading) >= kappa * dE94(actual, predicted)
/// > 0, and the pixel moves less than the limit; otherwise 1. Positions outside the frame or across a depth
/// discontinuity do not flicker.
Image flickerWeight(const FlickerInput& input, const FlickerSettings& settings = {});

}  // namespace limen::perception

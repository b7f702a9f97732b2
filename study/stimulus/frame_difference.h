// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "perception/vision/display.h"
#include "renderer/gl/context.h"
#include "study/stimulus/stimulus.h"
#include "study/stimulus/stimulus_scene.h"

namespace limen::perception {
class MetricGpu;
}

namespace limen::study {

class StimulusRenderer;

/// Image metrics of the two pictures that Predictor compares: the first frame after the change and, as
/// reference, the same frame in the state before it. They ignore motion. Light is relative to the display's
/// white, codes are divided by 255.
struct FrameDifference {
  double meanDe94 = 0.0;       ///< CIE94, mean over the window
  double flip = 0.0;           ///< mean LDR-FLIP at the display's pixels per degree
  double ssim = 1.0;           ///< 1 for equal pictures
  double rmse = 0.0;           ///< of light
  double rmseCoded = 0.0;      ///< of codes
  double colorVideoVdp = 0.0;  ///< 10 - JOD by ColorVideoVDP on the display, as still images
  /// 10 - JOD of the video of the frames up to kClipS before and after the change as they are shown, compared
  /// with the same without the change; none if not asked for.
  std::optional<double> colorVideoVdpClip;
};
nlohmann::json toJson(const FrameDifference& difference);

/// The length of ColorVideoVDP's temporal filters: what lies further from the change sees little of it.
inline constexpr double kClipS = 0.25;

/// Measures stimuli in one window of one display.
class FrameComparer {
 public:
  FrameComparer(gl::Context& context, glm::ivec2 windowPx, const perception::DisplayProfile& display);
  ~FrameComparer();
  FrameComparer(const FrameComparer&) = delete;
  FrameComparer& operator=(const FrameComparer&) = delete;

  /// Throws Error like StimulusRenderer; the stimulus must have a change.
  FrameDifference compare(const Stimulus& stimulus, bool clip = false);
  /// Versions and parameters of the metrics: what determines the figures besides stimulus, window and
  /// display.
  static nlohmann::json settings(bool clip = false);

 private:
  double flipPixelsPerDegree() const;
  double compareClip(StimulusRenderer& renderer) const;

  gl::Context& context_;
  glm::ivec2 windowPx_;
  perception::DisplayProfile display_;
  SceneCache scenes_;
  std::unique_ptr<perception::MetricGpu> gpu_;
};

}  // namespace limen::study

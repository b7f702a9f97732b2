// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/techniques/soft_shadows/multisample/multisample_settings.h"
#include "renderer/techniques/soft_shadows/multisample/pixel_samples.h"

namespace limen::techniques {

/// The points that visibility is found for if every pixel has one and each further surface that its samples
/// see another: their choice, and the way back to pixels.
class SurfacePoints {
 public:
  /// `format`: of visibilities. Without samples, the pixels' own points are all there are.
  SurfacePoints(frame::Frame& frame, const SurfaceSamples& settings, const PixelSamples* samples,
                gl::Format format);

  glm::ivec2 pointsPx() const { return pointsPx_; }
  /// What the points' frame is to see.
  frame::Seen seen(const frame::Frame& frame) const { return {&ids_, &places_, frame.sizePx()}; }
  const gl::Texture& visibility() const { return visibility_; }  ///< of pixels

  /// Writes the points; samples must have been drawn.
  void choose(frame::Frame& frame) const;
  /// From points' visibilities to pixels'.
  void resolve(frame::Frame& frame, const gl::Texture& ofPoints) const;

  struct Counts {
    uint32_t points, dropped, complexPixels;
  };
  Counts counts() const;  ///< of the last frame; waits for the GPU
  int64_t chooseBytes() const { return ids_.bytes() + places_.bytes() + counts_.bytes(); }

 private:
  SurfaceSamples settings_;
  const PixelSamples* samples_;
  glm::ivec2 ownPx_, pointsPx_;
  const gl::Program &ownPoints_, *surfaces_ = nullptr, *resolve_ = nullptr;
  gl::Texture ids_, places_, visibility_;
  gl::Buffer counts_;
};

}  // namespace limen::techniques

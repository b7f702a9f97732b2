// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "perception/band_thresholds/settings.h"
#include "perception/threshold_maps/threshold_maker.h"
#include "perception/vision/display.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// Thresholds by frequency band of images of one size, on the GPU in compute shaders. Agrees with
/// computeBandThresholds() for the same settings within 0.5 % of each value.
class BandThresholdGpu : public ThresholdMaker {
 public:
  /// Allocates and compiles for inputs of one format: colour (RGBA, linear, relative to `display`) or
  /// luminance (one channel, cd/m2). Throws Error on settings that only the reference supports (bilinear
  /// upsampling, adaptation to the mean).
  BandThresholdGpu(gl::Context& context, glm::ivec2 sizePx, const DisplayProfile& display,
                   const BandThresholdSettings& settings, bool colourInput = true);

  const gl::Texture& run(const gl::Texture& linearColourOrLuminance, gl::PassList* passes = nullptr,
                         const std::optional<MapArea>& only = {}) override;
  /// What settings.output asks for.
  const gl::Texture& map() const override { return map_; }

  /// From now on run() also writes the thresholds of each band. Allocates.
  void keepBands();
  /// "gaussian" (levels, as mipmaps), "combined" (of each band with all coarser ones, from band 1, as
  /// mipmaps) and, if kept, "bands" (thresholds of each, as mipmaps).
  std::map<std::string, const gl::Texture*> debugViews() const override;

  int bands() const { return bands_; }
  int levels() const override { return bands_ > 0 ? bands_ + 2 : 1; }
  int64_t bytesHeld() const override;
  int64_t bytesMoved(const gl::Texture& input) const override;

 private:
  const gl::Program& thresholdProgram(bool coarser) const;
  void reduce(const gl::Texture& input);
  void evaluate(const MapArea& area);

  gl::Context& context_;
  glm::ivec2 sizePx_;
  BandThresholdSettings settings_;
  int bands_, adaptationLevel_;
  std::optional<int> shownBand_;
  bool keepsBands_ = false;
  std::vector<float> gains_, spreads_;
  glm::vec3 light_, taps_;
  glm::vec2 evenTaps_;
  float uniformShare_, fixedLuminance_ = 0.0F;
  gl::Texture map_;
  std::optional<gl::Texture> levels_, coarser_, own_;
  std::optional<gl::Buffer> sensitivities_, steps_;
  const gl::Program *first_ = nullptr, *next_ = nullptr, *coarsest_ = nullptr, *other_ = nullptr,
                    *uniform_ = nullptr, *enlarge_ = nullptr;
};

}  // namespace limen::perception

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>

#include "perception/band_thresholds/settings.h"
#include "perception/vision/display.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/pass_list.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// Thresholds by frequency band of images of one size, on the GPU in compute shaders. Agrees with
/// computeBandThresholds() for the same settings within 0.5 % of each value.
class BandThresholdGpu {
 public:
  /// Allocates and compiles for inputs of one format: colour (RGBA, linear, relative to `display`) or
  /// luminance (one channel, cd/m2). Throws Error on settings that only the reference supports (bilinear
  /// upsampling, adaptation to the mean).
  BandThresholdGpu(gl::Context& context, glm::ivec2 sizePx, const DisplayProfile& display,
                   const BandThresholdSettings& settings, bool colourInput = true);

  /// Allocates and compiles nothing and does not wait. `passes`: times levels and thresholds separately.
  const gl::Texture& run(const gl::Texture& linearColourOrLuminance, gl::PassList* passes = nullptr);
  /// What settings.output asks for: R32F, cd/m2.
  const gl::Texture& map() const { return map_; }

  /// From now on run() also writes the thresholds of each band. Allocates.
  void keepBands();
  /// "gaussian" (levels, as mipmaps), "combined" (of each band with all coarser ones, from band 1, as
  /// mipmaps) and, if kept, "bands" (thresholds of each, as mipmaps).
  std::map<std::string, const gl::Texture*> debugViews() const;

  int bands() const { return bands_; }
  int64_t bytesHeld() const;
  /// Bytes that run() must move at least, each texture of each pass counted once.
  int64_t bytesMoved(const gl::Texture& input) const;

 private:
  const gl::Program& thresholdProgram(bool coarser) const;
  void reduce(const gl::Texture& input);
  void evaluate();

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

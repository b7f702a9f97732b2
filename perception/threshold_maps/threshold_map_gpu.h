// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "perception/threshold_maps/settings.h"
#include "perception/threshold_maps/threshold_maker.h"
#include "perception/vision/display.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// Threshold maps of images of one size, on the GPU in compute shaders. Agrees with computeThresholdMap() for
/// the same settings within 0.5 % of each pixel's threshold in 32 bits and 2 % in 16 bits (nine fetches in 16
/// bits aside, which are for comparison only: they store luminance less its mean and lose contrasts that are
/// faint beside the distance to it). One limit: rounding to 24 bits moves faint patterns by up to
/// 6e-8 F / (sum of contrasts + epsilon), 0.8 % of a flat field of 80 cd/m2. Luminances outside
/// 1e-4 to 1e6 cd/m2 are read there from the tables. Source: Schwarz 2009, section 9.4.
///
/// With 16 bits, not luminances are stored but band 0, the only intermediate result of full size, as signed
/// square roots; levels from 1, a third of the texels, stay in 32 bits. Contrasts are differences of
/// luminances: with 16-bit luminances a contrast of 5e-4 is all rounding error; with a 16-bit band it keeps
/// three digits.
///
/// In 32 bits, images of even sizes can store luminance, and level 1 with what its rounding took away,
/// instead of band 0 (ThresholdMapGpuSettings::finest).
class ThresholdMapGpu : public ThresholdMaker {
 public:
  /// Allocates and compiles for inputs of one format: colour (RGBA, linear, relative to `display`) or
  /// luminance (one channel, cd/m2). Throws Error on settings that only the reference supports (true_stack,
  /// expand; direct with models other than barten89 and ward).
  ThresholdMapGpu(gl::Context& context, glm::ivec2 sizePx, const DisplayProfile& display,
                  const ThresholdMapSettings& settings, const ThresholdMapGpuSettings& gpu = {},
                  bool colourInput = true);
  ~ThresholdMapGpu() override;

  const gl::Texture& run(const gl::Texture& linearColourOrLuminance, gl::PassList* passes = nullptr,
                         const std::optional<MapArea>& only = {}) override;
  const gl::Texture& map() const override { return threshold_; }

  /// From now on run() also writes RG32F: adaptation luminance [cd/m2] and elevation S. Allocates.
  void keepStages();
  /// "stages" (if kept), "band_0" or "luminance" (less a constant: nine fetches of 16 bits), "gaussian"
  /// (levels from 1, as mipmaps).
  std::map<std::string, const gl::Texture*> debugViews() const override;

  int levels() const override { return levels_; }
  int64_t bytesHeld() const override;
  int64_t bytesMoved(const gl::Texture& input) const override;

 private:
  struct Programs;
  void reduce(const gl::Texture& input);
  /// Whether level 0 is stored as luminance: for reductions of exactly 2:1, which make no band.
  bool storesLuminance() const;
  void reduceNineFetch(const gl::Texture& input);
  void evaluate(const MapArea& area);

  gl::Context& context_;
  glm::ivec2 sizePx_;
  ThresholdMapSettings settings_;
  ThresholdMapGpuSettings gpu_;
  [[maybe_unused]] bool colourInput_;  // only assertions ask for it
  int levels_;
  gl::ShaderDefines defines_;
  gl::Texture threshold_, finest_;
  std::optional<gl::Texture> gaussian_, rest_, stages_;  // rest_: of level 1
  std::optional<gl::Buffer> run_, tables_, elevations_, places_, taps_, patches_, mean_;
  std::vector<glm::ivec2> upward_, downward_;  // first entries in places_, by level
  glm::ivec2 tiles_;
  std::unique_ptr<Programs> programs_;
};

}  // namespace limen::perception

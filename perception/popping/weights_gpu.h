// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "perception/popping/settings.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// Like DisocclusionView: depths are linear, R32F, <= 0 for background; displacement has two channels,
/// pixels.
struct DisocclusionTextures {
  const gl::Texture* previousDepthOfPixel = nullptr;
  const gl::Texture* displacement = nullptr;
  const gl::Texture* previousDepth = nullptr;
};

/// Like FlickerInput. Both depths may be null.
struct FlickerTextures {
  const gl::Texture* actual = nullptr;
  const gl::Texture* predicted = nullptr;
  const gl::Texture* previousShading = nullptr;
  const gl::Texture* previousFrame = nullptr;
  const gl::Texture* displacement = nullptr;
  const gl::Texture* previousDepthOfPixel = nullptr;
  const gl::Texture* previousDepth = nullptr;
};

/// The weight maps of weights.h on the GPU. Colours are RGBA, linear. Neither call allocates or waits.
class PoppingWeightsGpu {
 public:
  /// A weight that `settings` ignores is made with the default settings.
  PoppingWeightsGpu(gl::Context& context, const PoppingSettings& settings);
  /// One or two views; `weight`: R32F of their size.
  void disocclusion(const std::vector<DisocclusionTextures>& views, const gl::Texture& weight);
  void flicker(const FlickerTextures& input, const gl::Texture& weight);

 private:
  gl::Context& context_;
  DisocclusionSettings disocclusion_;
  FlickerSettings flicker_;
};

}  // namespace limen::perception

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"

namespace limen::perception {

/// LDR-FLIP on the GPU: how much a viewer notices when two images are shown in turn. Andersson, Nilsson,
/// Akenine-Moeller, Oskarsson, Astroem and Fairchild, "FLIP: A Difference Evaluator for Alternating Images",
/// HPG 2020. Three dispatches: rows, columns, mean; the filters are separable. Makes everything it needs
/// once, for one image size.
class FlipGpu {
 public:
  /// A 0.7 m wide display of 3840 pixels seen from 0.7 m, the published default (rounded).
  static constexpr double kDefaultPixelsPerDegree = 67.02;
  static constexpr double kLeastPixelsPerDegree = 1.0, kMostPixelsPerDegree = 240.0;

  FlipGpu(gl::Context& context, glm::ivec2 sizePx, double pixelsPerDegree = kDefaultPixelsPerDegree);

  /// Compares without reading anything back. Textures: linear, R32F (shown as grey) or RGBA32F (alpha
  /// ignored), of this object's size; values are clamped to [0, 1]. A non-finite test channel counts as 0 or
  /// 1, whichever is farther from the reference.
  void run(const gl::Texture& test, const gl::Texture& reference);
  /// Mean of the last run's map, in [0, 1]. Waits for the GPU.
  float mean() const;
  float compute(const gl::Texture& test, const gl::Texture& reference) {
    run(test, reference);
    return mean();
  }
  /// R32F, in [0, 1], of the last run.
  const gl::Texture& map() const { return map_; }

  glm::ivec2 sizePx() const { return sizePx_; }
  double pixelsPerDegree() const { return pixelsPerDegree_; }
  int64_t bytesHeld() const;

 private:
  gl::Context& context_;
  glm::ivec2 sizePx_;
  double pixelsPerDegree_;
  int radius_;
  glm::ivec2 groups_;  // of the column pass
  gl::Texture testSensitivity_, referenceSensitivity_, detectors_, smoothed_, map_;
  gl::Buffer filters_, groupSums_, result_;
};

}  // namespace limen::perception

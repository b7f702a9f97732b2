// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace limen::perception {

/// FLIP's filters as one-dimensional kernels: taps -radius..radius, to be applied along rows and then along
/// columns.
struct FlipFilters {
  int radius = 0;
  /// Contrast sensitivity: achromatic, red-green, and the two Gaussians whose filtered images add up to
  /// blue-yellow.
  std::vector<glm::vec4> sensitivity;
  /// Gaussian, edge detector, point detector, unused. A detector acts along one direction, the Gaussian along
  /// the other.
  std::vector<glm::vec4> features;
};

/// Filters for a display with this many pixels per degree of visual angle. Source: Andersson et al.,
/// "FLIP: A Difference Evaluator for Alternating Images", HPG 2020, sections 4.1.1 and 4.2.1.
FlipFilters makeFlipFilters(double pixelsPerDegree);

}  // namespace limen::perception

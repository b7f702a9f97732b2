// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace limen::scene {

/// Heights over a square grid of points in x and z, row by row in z: the corner (0, 0) is at (low, low).
struct HeightField {
  int side = 0;  ///< points along a side, at least 2
  double low = 0.0, spacing = 1.0;
  std::vector<double> heights;

  double at(int i, int j) const {
    return heights[static_cast<size_t>(j) * static_cast<size_t>(side) + static_cast<size_t>(i)];
  }
  glm::dvec3 point(int i, int j) const { return {low + spacing * i, at(i, j), low + spacing * j}; }
  /// Bilinear; clamped to the edge.
  double height(double x, double z) const;
  /// Unit, by central differences, one-sided at the edge.
  glm::dvec3 normal(int i, int j) const;
  double highest() const;
};

struct MountainSetting {
  int side = 129;
  double size = 16.0;    ///< world units along a side, centred on the origin
  double relief = 2.0;   ///< heights lie in [0, relief]
  double feature = 5.0;  ///< size of the largest forms
  int octaves = 6;
  int64_t seed = 1;
};

/// Ridged fractal noise: value noise folded at its middle, octaves of half the size and half the height.
HeightField mountains(const MountainSetting& setting);

}  // namespace limen::scene

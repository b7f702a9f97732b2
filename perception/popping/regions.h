// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "experiments/base/image.h"
#include "perception/popping/settings.h"

namespace limen::perception {

/// A connected region in which popping may be visible.
struct PoppingRegion {
  uint32_t label = 0;  ///< from 1, in order of the regions' first pixels, row by row
  int64_t sizePx = 0;
  double sigma = 0.0;            ///< Minkowski sum of the difference over its pixels [JND]
  double rating = 0.0;           ///< R = ln(0.375 sigma) / ln 2.25; below 1 rarely, above 3 easily seen
  glm::ivec2 least{0}, most{0};  ///< bounding box, both corners inclusive
  double largestJnd = 0.0;
  glm::dvec2 centroidPx{0.0};  ///< mean of pixel centres; (0.5, 0.5) is the first pixel's
  double coverage = 0.0;       ///< share of the image
  double detectionProbability = 0.0;
};

/// Regions of an image and the way back from a pixel to its region.
struct RegionMap {
  int width = 0, height = 0;
  std::vector<uint32_t> labels;        ///< by pixel; 0: in no region
  std::vector<PoppingRegion> regions;  ///< regions[label - 1]

  /// Region at a pixel; null if there is none or the pixel lies outside.
  const PoppingRegion* at(int x, int y) const;
  /// Regions with pixels in the rectangle (corners inclusive) and their pixel counts, largest first.
  struct Share {
    const PoppingRegion* region = nullptr;
    int64_t pixels = 0;
  };
  std::vector<Share> in(glm::ivec2 least, glm::ivec2 most) const;
  /// Share of the pixels with mask > 0 that lie in a region: coverage of an object. 0 for an empty mask.
  double coverageOf(const Image& mask) const;
};

/// R(Sigma) = ln(scale * Sigma) / ln(base). Minus infinity for Sigma = 0.
double poppingRating(double sigma, const PoppingSettings& settings = {});

/// Connected pixels with jnd >= threshold, kept if they contain a seed pixel. `seeds`
/// empty: every pixel is a seed. `jnd` row by row; values that are not finite count as 0.
RegionMap findRegions(const std::vector<double>& jnd, const std::vector<uint8_t>& seeds, int width,
                      int height, const PoppingSettings& settings = {});

}  // namespace limen::perception

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>
#include <string>
#include <vector>

#include "renderer/techniques/soft_shadows/bitmask/light_samples.h"

namespace limen::techniques {

/// A pattern of light samples, with its samples as the thesis defines them.
struct SamplePattern {
  LightPattern pattern;
  int side;
  bool jittered;

  int samples() const { return side * side; }
  /// Sample (i, j) in 1/4 of the distance between two rows: whole numbers.
  glm::ivec2 quarters(int i, int j) const {
    if (!jittered) return {4 * i + 2, 4 * j + 2};
    return {4 * i + (j % 2 == 0 ? 1 : 3), 4 * j + (i % 2 == 0 ? 3 : 1)};
  }
  glm::dvec2 place(int i, int j) const { return glm::dvec2(quarters(i, j)) / (4.0 * side); }
};
inline const std::array<SamplePattern, 4> kSamplePatterns{{{LightPattern::Regular8, 8, false},
                                                           {LightPattern::Regular16, 16, false},
                                                           {LightPattern::Regular32, 32, false},
                                                           {LightPattern::Jittered16, 16, true}}};

using Quad = std::array<glm::vec2, 4>;
using Step = glm::i64vec2;  ///< 1/4096 of the distance between two samples

/// Corner on the grid of the exact masks.
Step toStep(glm::vec2 corner, int side);
/// Twice the signed area of a, b, c.
__int128 doubledArea(Step a, Step b, Step c);
/// Strict convex hull by Andrew's monotone chain, counter-clockwise; fewer than three corners: no area.
std::vector<Step> monotoneChain(std::vector<Step> points);
/// Samples within a strict convex polygon, one by one. A sample on an edge counts as lying a little to the
/// left of its place, and far less below it.
std::vector<bool> samplesWithin(const std::vector<Step>& hull, const SamplePattern& pattern);
/// Smallest distance of a sample from the hull's edges' lines, in light extents.
double distanceFromEdges(const std::vector<Step>& hull, glm::dvec2 sample, int side);

/// Quads of every kind that can be told apart, the plain ones first: any corners in and around the light; on
/// samples and cell borders; a float beside them; small; slivers; three and four on a line; repeated corners.
std::vector<Quad> hardQuads(const SamplePattern& pattern, int count);
/// Quads as a shadow map gives them: cells of a slightly uneven mesh of `perLight` cells along the light.
std::vector<Quad> meshQuads(int perLight, int count, unsigned seed);

}  // namespace limen::techniques

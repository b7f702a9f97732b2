// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace limen::techniques {

/// What light samples emit, as shares of all that the samples emit: channel by channel they sum to 1 (to 0
/// where the light has none of a channel). Source: Schwarz 2009, section 4.2.2.
///
/// A place emits the sum of the radiances of the parts that it lies in. `cells` > 0: a sample stands for its
/// cell of a square grid of as many cells a side, and emits its mean; 0: what is emitted at its own place.
/// Samples off the light emit nothing.
std::vector<glm::dvec3> emissionShares(const scene::AreaLight& light, const std::vector<glm::dvec2>& samples,
                                       int cells);

/// A colour that some samples have, and which ones: bit b of the words is sample b.
struct ColourMask {
  glm::dvec3 share{0.0};  ///< of one sample
  std::vector<uint32_t> mask;
};
/// One for each share that differs, in order of their first samples; samples that emit nothing are left out.
std::vector<ColourMask> colourMasks(const std::vector<glm::dvec3>& shares);

/// Sums of shares for groups of `groupBits` samples (4, 8 or 16) and all patterns of visible ones: entry
/// group * 2^groupBits + pattern, red and green as halves in the first word (red low), blue in the second.
/// Sums are multiplied by the number of samples, so that halves hold them with their full 11 bits. The last
/// group may have fewer samples.
std::vector<glm::uvec2> colourTable(const std::vector<glm::dvec3>& shares, int groupBits);

}  // namespace limen::techniques

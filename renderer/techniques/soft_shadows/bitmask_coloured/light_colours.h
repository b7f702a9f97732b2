// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace limen::techniques {

/// The emission of light samples, as shares of their total: each channel sums to 1 (to 0 for a channel that
/// the light does not have). Source: Schwarz 2009, section 4.2.2.
///
/// A point emits the sum of the radiances of the parts that contain it. `cells` > 0: a sample represents its
/// cell of a square grid with this many cells per side, and emits the mean over it; 0: the emission at its
/// own position. Samples off the light emit nothing.
std::vector<glm::dvec3> emissionShares(const scene::AreaLight& light, const std::vector<glm::dvec2>& samples,
                                       int cells);

/// A colour that some samples have, and which ones: bit b of the words is sample b.
struct ColourMask {
  glm::dvec3 share{0.0};  ///< of one sample
  std::vector<uint32_t> mask;
};
/// One per distinct share, in order of their first samples; samples that emit nothing are left out.
std::vector<ColourMask> colourMasks(const std::vector<glm::dvec3>& shares);

/// Sums of shares for groups of `groupBits` samples (4, 8 or 16) and all patterns of visible ones: entry
/// group * 2^groupBits + pattern, red and green as halves in the first word (red low), blue in the second.
/// Sums are multiplied by the number of samples, so that halves hold them with their full 11 bits. The last
/// group may have fewer samples.
std::vector<glm::uvec2> colourTable(const std::vector<glm::dvec3>& shares, int groupBits);

}  // namespace limen::techniques

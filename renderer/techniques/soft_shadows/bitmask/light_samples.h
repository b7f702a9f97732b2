// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace limen::techniques {

/// Names of the patterns of light samples, those on grids first.
std::vector<std::string> lightSamplePatterns();
/// True if masks of rectangles are worked out by arithmetic; of others a table holds them.
bool isGridPattern(const std::string& pattern);

/// Places of a pattern's light samples in unit light coordinates, in the order of the mask's bits; a whole
/// number of words of 32 bits, at most 1024. Grids come in rows of ascending y, each of ascending x. `seed`
/// decides random and stratified patterns. Source: Schwarz 2009, section 4.2.1.
std::vector<glm::dvec2> lightSamples(const std::string& pattern, int64_t seed = 1);

/// Mask of the samples that lie on a light which need not fill its bounding rectangle: bit b of the words is
/// sample b. Throws Error if there are none. Source: Schwarz 2009, section 4.2.2.
std::vector<uint32_t> lightMask(const scene::AreaLight& light, const std::vector<glm::dvec2>& samples);
/// Bits that are set.
int bitCount(const std::vector<uint32_t>& mask);

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace limen::techniques {

/// Ranks of the samples in a window of `window` x `window`, 1 to 4, row by row from the top left: 0 is shaded
/// first. Dither matrices in which consecutive samples lie far apart (Holländer 2013, Fig. 4.7; Bayer 1973).
std::vector<int> windowRanks(int window);
/// Column and row of the sample of each rank.
std::vector<glm::ivec2> windowOrder(int window);
/// The same as elements of a GLSL array of ivec2.
std::string windowOrderGlsl(int window);

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace limen::techniques {

/// Points in the unit square, denser towards its centre like a Gaussian of deviation `sigma` (in sides), none
/// nearer to another than the local density allows: x, y, and the share of the square's area that the point
/// represents, one over the density; shares sum to 1. Source: Schwarz 2009, section 3.2.1 (after Bavoil and
/// Silva 2006; how their set was made is reconstructed).
std::vector<glm::vec4> gaussianTaps(int count, double sigma, int64_t seed);

}  // namespace limen::techniques

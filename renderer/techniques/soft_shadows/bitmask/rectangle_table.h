// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/gl/texture.h"

namespace limen::techniques {

/// Masks of the light samples within rectangles that start at the light's lower corner; masks of all other
/// rectangles follow as with a summed-area table. Source: Schwarz 2009, section 4.2.1.
///
/// Texel (i, j) of size + 1 on either axis holds the samples with x <= i / size and y <= j / size. `samples`
/// are at most 1024, a multiple of 128, in unit light coordinates; bit b is sample b, 128 to a layer.
gl::Texture makeRectangleTable(const std::vector<glm::dvec2>& samples, int size);

}  // namespace limen::techniques

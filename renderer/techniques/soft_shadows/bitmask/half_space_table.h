// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/gl/texture.h"

namespace limen::techniques {

/// Masks of the light samples to the left of lines across the light. Source: Schwarz 2009, section 4.4.4
/// (after Eisemann and Decoret 2007).
///
/// Column i holds lines at an angle of pi i / size to the light's x axis, i.e. lines that point upwards; row
/// k those that have the light's lower corner at r = sqrt(2) (2 k / (size - 1) - 1) to their right. A sample
/// on a line counts as lying to its left, and on a horizontal one as below it. The thesis tabulates angles
/// from -pi to pi; those of lines that point downwards are the complements (half_space_table.glsl).
///
/// `samples` are at most 1024 in unit light coordinates; bit b of the masks is sample b, 32 to a word, words
/// in layers of four channels (of two where there are at most 64 samples).
gl::Texture makeHalfSpaceTable(const std::vector<glm::dvec2>& samples, int size);

/// Largest distance, over the light, between a line that meets the light and the table's line for it: half a
/// step of distance plus half a step of angle across the light's diagonal.
double halfSpaceTableError(int size);

}  // namespace limen::techniques

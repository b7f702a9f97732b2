// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>

namespace limen::techniques {

/// Runs the program in use over voxels, in groups of kPropagateGroup a side; what it writes to images can
/// then be read.
void dispatchVoxels(glm::ivec3 size);

}  // namespace limen::techniques

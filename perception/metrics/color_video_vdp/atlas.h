// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace limen::perception::cvvdp {

/// Places for the levels of a pyramid in one texture: the finest at the origin, the next below it, the others
/// in a column beside that one. Sizes halve, rounded up.
struct Atlas {
  struct Level {
    glm::ivec2 origin, sizePx;
  };
  std::vector<Level> levels;
  glm::ivec2 sizePx{0};

  Atlas(glm::ivec2 finest, size_t levelCount);
};

}  // namespace limen::perception::cvvdp

// SPDX-License-Identifier: BSD-3-Clause
#include "perception/metrics/color_video_vdp/atlas.h"

namespace limen::perception::cvvdp {

Atlas::Atlas(glm::ivec2 finest, size_t levelCount) {
  glm::ivec2 origin(0), size = finest;
  for (size_t level = 0; level < levelCount; ++level) {
    levels.push_back({origin, size});
    sizePx = glm::max(sizePx, origin + size);
    if (level == 1) {
      origin.x += size.x;
    } else {
      origin.y += size.y;
    }
    size = (size + 1) / 2;
  }
}

}  // namespace limen::perception::cvvdp

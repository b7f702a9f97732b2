// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/bitmask/rectangle_table.h"

#include <cassert>
#include <cmath>

namespace limen::techniques {

gl::Texture makeRectangleTable(const std::vector<glm::dvec2>& samples, int size) {
  assert(samples.size() % 128 == 0);
  const size_t side = static_cast<size_t>(size) + 1;
  gl::Texture table(gl::Format::RGBA32UI, glm::ivec2(size + 1), 1, static_cast<int>(samples.size() / 128));
  for (size_t first = 0; first < samples.size(); first += 128) {
    std::vector<uint32_t> texels(side * side * 4, 0);
    // Enter each sample in the first texel that contains it, then OR rows and columns into the following
    // ones.
    for (size_t bit = 0; bit < 128; ++bit) {
      const glm::dvec2 at = glm::ceil(samples[first + bit] * double(size));
      const auto column = static_cast<size_t>(at.x), row = static_cast<size_t>(at.y);
      texels[(row * side + column) * 4 + bit / 32] |= 1U << (bit % 32);
    }
    for (size_t row = 0; row < side; ++row)
      for (size_t column = 0; column < side; ++column)
        for (size_t word = 0; word < 4; ++word) {
          const size_t here = (row * side + column) * 4 + word;
          if (column > 0) texels[here] |= texels[here - 4];
          if (row > 0) texels[here] |= texels[here - 4 * side];
        }
    table.writeUint(texels, static_cast<int>(first / 128));
  }
  return table;
}

}  // namespace limen::techniques

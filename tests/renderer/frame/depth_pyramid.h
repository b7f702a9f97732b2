// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>

#include "experiments/base/image.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// Smallest and largest value of the texels [low, high) of a map, one by one.
inline glm::vec2 rangeOf(const Image& map, glm::ivec2 low, glm::ivec2 high) {
  glm::vec2 range(2e30F, -2e30F);
  for (int y = low.y; y < high.y; ++y)
    for (int x = low.x; x < high.x; ++x)
      range = {std::min(range.x, map.at(x, y)), std::max(range.y, map.at(x, y))};
  return range;
}

/// A pyramid laid out as MinMaxPyramid's, over any square map of a power of two and filled on the CPU.
class DepthPyramid {
 public:
  explicit DepthPyramid(const Image& map)
      : levels_(std::bit_width(static_cast<unsigned>(map.width))),
        minimum_(gl::Format::R32F, {map.width, map.height}, levels_),
        maximum_(gl::Format::R32F, glm::max(glm::ivec2(map.width, map.height) / 2, 1),
                 std::max(levels_ - 1, 1)) {
    minimum_.write(map);
    for (int level = 1; level < levels_; ++level) {
      const int side = map.width >> level;
      Image minimum(side, side, 1), maximum(side, side, 1);
      for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
          const glm::vec2 range = rangeOf(map, glm::ivec2(x, y) << level, glm::ivec2(x + 1, y + 1) << level);
          minimum.at(x, y) = range.x, maximum.at(x, y) = range.y;
        }
      minimum_.write(minimum, level);
      maximum_.write(maximum, level - 1);
    }
  }

  const gl::Texture& minimum() const { return minimum_; }
  const gl::Texture& maximum() const { return maximum_; }
  int levels() const { return levels_; }

 private:
  int levels_;
  gl::Texture minimum_, maximum_;
};

}  // namespace limen::frame

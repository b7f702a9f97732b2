// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/antialiasing/window_order.h"

#include <stdexcept>

namespace limen::techniques {

std::vector<int> windowRanks(int window) {
  switch (window) {
    case 1:
      return {0};
    case 2:
      return {0, 2,  //
              3, 1};
    case 3:
      return {2, 6, 3,  //
              5, 0, 8,  //
              1, 7, 4};
    case 4:
      return {1,  8,  2,  10,  //
              12, 4,  14, 6,   //
              3,  11, 0,  9,   //
              15, 7,  13, 5};
    default:
      throw std::logic_error("no order for a window of this size");
  }
}

std::vector<glm::ivec2> windowOrder(int window) {
  const std::vector<int> ranks = windowRanks(window);
  std::vector<glm::ivec2> order(ranks.size());
  for (int i = 0; i < window * window; ++i) order[size_t(ranks[size_t(i)])] = {i % window, i / window};
  return order;
}

std::string windowOrderGlsl(int window) {
  std::string out;
  for (const glm::ivec2& place : windowOrder(window))
    out += (out.empty() ? "ivec2(" : ", ivec2(") + std::to_string(place.x) + ", " + std::to_string(place.y) +
           ")";
  return out;
}

}  // namespace limen::techniques

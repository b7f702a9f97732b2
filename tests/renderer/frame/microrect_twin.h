// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "experiments/base/image.h"
#include "renderer/frame/microrect_map.h"

namespace limen::frame {

/// A microrect with both bounds inclusive, in texels of level 0.
struct TwinRect {
  glm::ivec2 low{std::numeric_limits<int>::max()}, high{-1};
  float z = std::numeric_limits<float>::infinity();
  void add(const TwinRect& other) {
    low = glm::min(low, other.low), high = glm::max(high, other.high), z = std::min(z, other.z);
  }
  bool holds(const TwinRect& other) const {
    return glm::all(glm::lessThanEqual(low, other.low)) && glm::all(glm::greaterThanEqual(high, other.high));
  }
};

/// Microrects of one level by asking of each finer one who owns it, whereas the shader asks each of the
/// coarser level what it takes. A microrect with an odd index goes to the neighbour that differs least from
/// it in depth (to the upper one in a tie, to the lower one if there is no other); one that is odd on both
/// axes to that at its lower left if what this owns already spans it, and else to that at its upper right
/// (where that is off the map, as along the border); or, by the other rule, to the nearest in depth of the
/// four around it.
class MicrorectTwin {
 public:
  explicit MicrorectTwin(const Image& map) : side_(map.width) {
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) rects_.push_back({{x, y}, {x, y}, map.at(x, y)});
  }

  int side() const { return side_; }
  const TwinRect& at(int x, int y) const { return rects_[static_cast<size_t>(y * side_ + x)]; }

  void coarsen(MergeRule rule) {
    const int half = side_ / 2;
    std::vector<TwinRect> next(static_cast<size_t>(half) * static_cast<size_t>(half));
    const auto give = [&](int x, int y, glm::ivec2 owner) {
      next[static_cast<size_t>(owner.y / 2 * half + owner.x / 2)].add(at(x, y));
    };
    const auto owner = [&](int x, int y) -> glm::ivec2 {
      const glm::ivec2 axis(x % 2, y % 2), here(x, y), above = here + axis;
      if (std::max(above.x, above.y) >= side_) return here - axis;
      const glm::ivec2 below = here - axis;
      return nearer(at(x, y).z, at(below.x, below.y).z, at(above.x, above.y).z, rule.metric) ? below : above;
    };
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x)
        if (x % 2 == 0 || y % 2 == 0) give(x, y, x % 2 + y % 2 == 0 ? glm::ivec2(x, y) : owner(x, y));
    // The thesis looks at the extents that the merges up the axes lead to, before those down them.
    for (int y = 1; y < side_; y += 2)
      for (int x = 1; x < side_; x += 2) {
        const glm::ivec2 lower(x - 1, y - 1);
        if (rule.diagonal == DiagonalMerge::Nearest) {
          give(x, y, nearestOfFour(x, y, rule.metric));
          continue;
        }
        TwinRect span = at(lower.x, lower.y);
        if (owner(x, y - 1) == lower) span.add(at(x, y - 1));
        if (owner(x - 1, y) == lower) span.add(at(x - 1, y));
        // Off the map, what is kept there is not: the other one along the border instead.
        glm::ivec2 other(x + 1, y + 1);
        if (other.x >= side_) other.x = lower.x;
        if (other.y >= side_) other.y = lower.y;
        const bool atBorder = std::max(x, y) + 1 >= side_;
        const bool isNearer =
            atBorder && nearer(at(x, y).z, at(lower.x, lower.y).z, at(other.x, other.y).z, rule.metric);
        give(x, y, span.holds(at(x, y)) || isNearer ? lower : other);
      }
    rects_ = std::move(next);
    side_ = half;
  }

 private:
  /// Whether `between` is nearer to `a` than to `b`. Products of two floats are exact in double.
  static bool nearer(float between, float a, float b, MergeMetric metric) {
    const double toA = std::abs(between - a), toB = std::abs(between - b);
    if (metric == MergeMetric::Absolute) return toA < toB;
    return toA * double(std::min(between, b)) < toB * double(std::min(between, a));
  }

  /// The upper right one in a tie, then the lower left one, then the lower right one.
  glm::ivec2 nearestOfFour(int x, int y, MergeMetric metric) const {
    std::vector<glm::ivec2> around;
    for (const glm::ivec2 offset : {glm::ivec2(1, 1), {-1, -1}, {1, -1}, {-1, 1}})
      if (x + offset.x < side_ && y + offset.y < side_) around.push_back(glm::ivec2(x, y) + offset);
    const auto closer = [&](glm::ivec2 a, glm::ivec2 b) {
      return nearer(at(x, y).z, at(a.x, a.y).z, at(b.x, b.y).z, metric);
    };
    return *std::min_element(around.begin(), around.end(), closer);
  }

  int side_;
  std::vector<TwinRect> rects_;
};

}  // namespace limen::frame

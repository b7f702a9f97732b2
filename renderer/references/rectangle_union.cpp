// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/rectangle_union.h"

#include <algorithm>

namespace limen::references {

void RectangleUnion::add(glm::dvec2 low, glm::dvec2 high) {
  if (low.x < high.x && low.y < high.y) rectangles_.push_back({low, high});
}

void RectangleUnion::update(size_t node, uint32_t first, uint32_t last, const Side& side) {
  if (side.last <= first || last <= side.first) return;
  Node& here = nodes_[node];
  if (side.first <= first && last <= side.last) {
    here.covered += side.change;
  } else {
    const uint32_t middle = (first + last) / 2;
    update(2 * node, first, middle, side);
    update(2 * node + 1, middle, last, side);
  }
  if (here.covered > 0)
    here.length = ys_[last] - ys_[first];
  else
    here.length = last - first == 1 ? 0.0 : nodes_[2 * node].length + nodes_[2 * node + 1].length;
}

double RectangleUnion::coveredWithin(size_t node, uint32_t first, uint32_t last, glm::dvec2 strip,
                                     const HalfPlane& within) const {
  if (nodes_[node].length == 0.0) return 0.0;
  if (nodes_[node].covered > 0) {
    const double low = ys_[first], high = ys_[last];
    ConvexPolygon inside, outside;
    split({{strip.x, low}, {strip.y, low}, {strip.y, high}, {strip.x, high}}, within, inside, outside);
    return inside.area();
  }
  const uint32_t middle = (first + last) / 2;
  return coveredWithin(2 * node, first, middle, strip, within) +
         coveredWithin(2 * node + 1, middle, last, strip, within);
}

double RectangleUnion::areaWithin(const HalfPlane* within) {
  if (rectangles_.empty()) return 0.0;
  ys_.clear(), sides_.clear();
  for (const Rectangle& r : rectangles_) ys_.push_back(r.low.y), ys_.push_back(r.high.y);
  std::sort(ys_.begin(), ys_.end());
  ys_.erase(std::unique(ys_.begin(), ys_.end()), ys_.end());
  const auto indexOf = [&](double y) {
    return static_cast<uint32_t>(std::lower_bound(ys_.begin(), ys_.end(), y) - ys_.begin());
  };
  for (const Rectangle& r : rectangles_) {
    const uint32_t first = indexOf(r.low.y), last = indexOf(r.high.y);
    sides_.push_back({r.low.x, first, last, 1});
    sides_.push_back({r.high.x, first, last, -1});
  }
  std::sort(sides_.begin(), sides_.end(), [](const Side& a, const Side& b) { return a.x < b.x; });
  const auto intervals = static_cast<uint32_t>(ys_.size() - 1);
  nodes_.assign(4 * size_t{intervals}, Node());

  double sum = 0.0;
  for (size_t i = 0; i < sides_.size(); ++i) {
    if (i > 0 && sides_[i].x > sides_[i - 1].x) {
      const glm::dvec2 strip(sides_[i - 1].x, sides_[i].x);
      sum += within ? coveredWithin(1, 0, intervals, strip, *within) : nodes_[1].length * (strip.y - strip.x);
    }
    update(1, 0, intervals, sides_[i]);
  }
  return sum;
}

}  // namespace limen::references

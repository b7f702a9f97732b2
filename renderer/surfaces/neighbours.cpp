// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/neighbours.h"

#include <algorithm>
#include <cstring>
#include <string>
#include <string_view>
#include <unordered_map>

#include "renderer/surfaces/bezier.h"

namespace limen::surfaces {
namespace {

/// A side in the direction whose control points come first in the order of their bytes.
struct SideKey {
  std::string bytes;
  bool turned = false;  ///< against the side's own direction
};

std::string bytesOf(const std::vector<glm::dvec4>& points) {
  std::string out(points.size() * sizeof(glm::dvec4), '\0');
  std::memcpy(out.data(), points.data(), out.size());
  return out;
}

SideKey keyOf(std::vector<glm::dvec4> points) {
  for (glm::dvec4& point : points) point += 0.0;  // -0 becomes 0
  std::string forwards = bytesOf(points);
  std::reverse(points.begin(), points.end());
  std::string backwards = bytesOf(points);
  const bool turned = backwards < forwards;
  return {std::move(turned ? backwards : forwards), turned};
}

struct Side {
  int32_t patch = 0, side = 0;
  bool turned = false;
};

/// The sides that have the same control points: the first two and how many.
struct Group {
  std::array<Side, 2> sides;
  size_t count = 0;
};

}  // namespace

SideCounts findNeighbours(PatchSet& set) {
  SideCounts counts;
  std::unordered_map<std::string, Group> groups;
  groups.reserve(2 * set.patches.size());
  set.neighbours.assign(set.patches.size(), {});
  for (size_t p = 0; p < set.patches.size(); ++p)
    for (int side = 0; side < sidesOf(set.patches[p].domain); ++side) {
      if (isCollapsed(set, set.patches[p], side)) {
        ++counts.collapsed;
        continue;
      }
      SideKey key = keyOf(sidePoints(set, set.patches[p], side));
      Group& group = groups[std::move(key.bytes)];
      if (group.count < 2) group.sides[group.count] = {static_cast<int32_t>(p), side, key.turned};
      ++group.count;
    }
  for (const auto& [key, group] : groups) {
    if (group.count != 2) {
      (group.count == 1 ? counts.open : counts.crowded) += group.count;
      continue;
    }
    const auto& [a, b] = group.sides;
    const bool reversed = a.turned != b.turned;
    set.neighbours[static_cast<size_t>(a.patch)][static_cast<size_t>(a.side)] = {b.patch, b.side, reversed};
    set.neighbours[static_cast<size_t>(b.patch)][static_cast<size_t>(b.side)] = {a.patch, a.side, reversed};
    counts.shared += 2;
  }
  return counts;
}

}  // namespace limen::surfaces

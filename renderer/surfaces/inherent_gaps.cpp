// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/inherent_gaps.h"

#include <algorithm>
#include <map>
#include <utility>

#include "renderer/surfaces/bezier.h"

namespace limen::surfaces {
namespace {

using glm::dvec3;

dvec3 sidePosition(const PatchSet& set, const Patch& patch, int side, int q, int n) {
  return evaluate(set, patch, sidePoint(patch.domain, side, q, n), Order::Position).p + 0.0;
}

dvec3 unitOrNull(dvec3 v) {
  const double length = glm::length(v);
  return length > 0.0 ? v / length : dvec3(0.0);
}

/// Of the polygon through the corners.
dvec3 faceNormal(const PatchSet& set, const Patch& patch) {
  const auto corner = [&](int s) { return sidePosition(set, patch, s, 0, 1); };
  return unitOrNull(patch.domain == Domain::Triangle
                        ? glm::cross(corner(1) - corner(0), corner(2) - corner(0))
                        : glm::cross(corner(2) - corner(0), corner(3) - corner(1)));
}

/// Turned as the first patch, which lies to the left of its side.
dvec3 meanStripNormal(const PatchSet& set, const InherentGap& gap) {
  const Patch &a = set.patches[gap.patches[0]], &b = set.patches[gap.patches[1]];
  const dvec3 start = sidePosition(set, a, gap.sides[0], 0, 2),
              end = sidePosition(set, a, gap.sides[0], 2, 2), ofA = sidePosition(set, a, gap.sides[0], 1, 2),
              ofB = sidePosition(set, b, gap.sides[1], 1, 2);
  return unitOrNull(glm::cross(ofB - start, ofA - start)) + unitOrNull(glm::cross(ofB - ofA, end - ofA));
}

struct EndsBefore {
  bool operator()(const std::array<dvec3, 2>& a, const std::array<dvec3, 2>& b) const {
    const auto lexicographic = [](const dvec3& v) { return std::array{v.x, v.y, v.z}; };
    return std::pair(lexicographic(a[0]), lexicographic(a[1])) <
           std::pair(lexicographic(b[0]), lexicographic(b[1]));
  }
};

struct OpenSide {
  uint32_t patch;
  int side;
  bool turned;  // against the order of the key
};

}  // namespace

std::vector<InherentGap> inherentGaps(const PatchSet& set) {
  std::map<std::array<dvec3, 2>, std::vector<OpenSide>, EndsBefore> groups;
  for (uint32_t p = 0; p < set.patches.size(); ++p)
    for (int side = 0; side < sidesOf(set.patches[p].domain); ++side) {
      if (set.neighbours[p][static_cast<size_t>(side)].patch >= 0 || isCollapsed(set, set.patches[p], side))
        continue;
      std::array<dvec3, 2> ends = {sidePosition(set, set.patches[p], side, 0, 1),
                                   sidePosition(set, set.patches[p], side, 1, 1)};
      const bool turned = EndsBefore()({ends[1], ends[0]}, ends);
      if (turned) std::swap(ends[0], ends[1]);
      groups[ends].push_back({p, side, turned});
    }
  std::vector<InherentGap> out;
  for (const auto& [ends, sides] : groups) {
    if (sides.size() != 2 || sides[0].turned == sides[1].turned) continue;
    InherentGap gap{{sides[0].patch, sides[1].patch}, {sides[0].side, sides[1].side}, 0};
    const dvec3 strip = meanStripNormal(set, gap);
    gap.normalsFrom = glm::dot(faceNormal(set, set.patches[gap.patches[1]]), strip) >
                              glm::dot(faceNormal(set, set.patches[gap.patches[0]]), strip)
                          ? 1
                          : 0;
    out.push_back(gap);
  }
  std::sort(out.begin(), out.end(), [](const InherentGap& a, const InherentGap& b) {
    return std::pair(a.patches[0], a.sides[0]) < std::pair(b.patches[0], b.sides[0]);
  });
  return out;
}

}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
// Trimmed surfaces: what is left of a parameter domain inside closed curves (Schwarz 2009, section 6.1.4;
// SC-18).
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace limen::surfaces {

/// Closed curves in the unit square as polygons. A place is left if it lies inside an odd number of them.
struct TrimRegion {
  std::vector<std::vector<glm::dvec2>> loops;
  bool contains(glm::dvec2 at) const;
  double area() const;  ///< between the polygons; loops must not cross one another
};

/// From p to the nearest point of a segment.
double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b);

/// visit(a, b) for all sides of all polygons.
template <class Visit>
void forSegments(const TrimRegion& region, Visit visit) {
  for (const std::vector<glm::dvec2>& loop : region.loops)
    for (size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[(i + 1) % loop.size()]);
}

/// Polygon of a closed chain of Bézier curves, rational if weights (z) differ: homogeneous (w x, w y, w).
/// Each ends where the next begins; `segments` of each.
std::vector<glm::dvec2> trimLoop(std::span<const std::vector<glm::dvec3>> curves, int segments);

/// A circle of four rational quarters, counter-clockwise, as such a polygon.
std::vector<glm::dvec2> trimCircle(glm::dvec2 centre, double radius, int segments);

}  // namespace limen::surfaces

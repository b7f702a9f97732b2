// SPDX-License-Identifier: BSD-3-Clause
// Prisms that enclose Bézier triangles, as proxies for casting rays at them (Schwarz 2009, section 6.5.2;
// SC-30).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/surfaces/blossom.h"

namespace limen::surfaces {

/// Bases are parallel to the plane of the part's corners. Convex; contains the part, with a slack of 0.1 % of
/// its size on all sides against rounding.
struct PnPrism {
  /// Lower base, then upper one; both counter-clockwise seen from above, the side from which the corners are.
  std::array<glm::dvec3, 6> corners;
  /// (u, v) of the whole triangle at which a base's corners lie in the plane of the part's corners, extended
  /// beyond the domain; the domain's middle if the part's corners lie on a line.
  std::array<glm::dvec2, 3> parameters;
};

/// Triangles of a prism's surface, counter-clockwise seen from outside.
inline constexpr std::array<std::array<uint8_t, 3>, 8> kPrismTriangles = {
    {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}}};

/// Of a part of a polynomial triangle of degree n <= kMaxDegree. Heights and sides are fitted to the control
/// points of the part's four quarters, whose hull contains it. Sides are parallel to those of the corners'
/// triangle; where that would take more area, as with needles, the base is an isosceles triangle along the
/// longest side.
PnPrism pnPrism(int n, std::span<const glm::dvec3> points, const TrianglePart& part = kWholeTriangle);

/// 4^level parts of equal shape.
std::vector<TrianglePart> partsOf(int level);

}  // namespace limen::surfaces

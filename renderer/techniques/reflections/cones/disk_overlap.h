// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>

namespace limen::techniques {

/// What a figure has in common with the unit disk around 0.
struct DiskOverlap {
  double area = 0.0;         ///< 0 to pi
  glm::dvec2 centroid{0.0};  ///< 0 where the area is 0
};

/// Of a convex polygon, corners in either order: the sum over its edges of triangles and sectors from the
/// centre (Roger 2008, section 5.2, without its cases; reconstructed). Fewer than three corners, and polygons
/// without area, have none.
DiskOverlap diskOverlapByEdges(std::span<const glm::dvec2> polygon);

/// Of a triangle, by the eight cases of Roger 2008, section 5.2: by how many of its corners lie inside, and
/// how often its edges cross the circle. Each is a polygon and circular segments.
struct DiskCase {
  int cornersInside = 0, crossings = 0;
};
DiskOverlap diskOverlapByCases(const std::array<glm::dvec2, 3>& triangle, DiskCase* found = nullptr);

/// Part of the disk beyond a chord that spans `angle` at the centre, 0 to 2 pi: its area, and how far from
/// the centre its centroid is. 2 sin^3(angle / 2) / (3 area): the exponent 3/2 that the thesis prints
/// (equation 5.10) is an error.
struct CircularSegment {
  double area = 0.0, centroidDistance = 0.0;
};
CircularSegment circularSegment(double angle);

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
// Tessellation patterns of others, to compare ours with (Schwarz 2009, sections 7.3 and 7.3.2; SC-49).
#pragma once

#include <vector>

#include "renderer/surfaces/patterns.h"

namespace limen::surfaces {

struct PatternMesh {
  std::vector<glm::dvec2> points;     ///< (u, v)
  std::vector<glm::uvec3> triangles;  ///< counter-clockwise
};

/// Our own pattern in the same form.
PatternMesh patternMesh(Domain domain, const Factors& factors, bool cornerFix = true);

/// What the driver's tessellator makes with equal spacing: rings around the middle, with two segments fewer
/// each. `inner`: along u and v; a triangle takes x. Strips between rings are made as ours; drivers choose
/// diagonals freely. (OpenGL 4.5, section 11.2.2; Direct3D 11)
PatternMesh concentricPattern(Domain domain, const Factors& outer, glm::ivec2 inner);

/// Moreton's pattern of a rectangle: ours with the larger of opposite factors inside (Moreton 2001).
PatternMesh moretonPattern(const Factors& factors);

/// Smallest angle of all triangles [degree] and their number, in an equilateral or square domain.
struct PatternShape {
  double smallestAngleDeg = 0.0;
  size_t points = 0, triangles = 0;
};
PatternShape shapeOf(Domain domain, const PatternMesh& mesh);

}  // namespace limen::surfaces

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

// Of a triangle; side s from corner s to corner s + 1 has factor s.

/// Uniform factors as ours; otherwise a core of the largest factor less two, joined to all three sides, with
/// edges between corners flipped where they are the longest on both of their sides (Chung and Kim 2003).
PatternMesh chungKimPattern(const Factors& factors);

/// Moreton's rectangle with the side opposite to `base` collapsed to a corner.
PatternMesh collapsedPattern(const Factors& factors, int base = 0);

/// Three schemes of which the one with the fewest triangles is meant to be chosen (Bruijns 1998).
enum class BruijnsScheme {
  Fixed,            ///< FFS: uniform factors alone, as ours; of others the largest is taken
  ConstantMaximum,  ///< CMVS: collapsedPattern() on the side of the smallest factor
  LinearMaximum  ///< LMVS: a core of the smallest factor less three and a sample more between its corners and
                 ///< the triangle's; below a factor of four all triangles meet in the middle
};
PatternMesh bruijnsPattern(BruijnsScheme scheme, const Factors& factors);

/// A core stretched to the two largest factors, without the faces that reach beyond the third side's margin,
/// and stitched to the sides (Kumar 1996). Where no face is left, all triangles meet in the core's corner.
PatternMesh kumarPattern(const Factors& factors);

/// Smallest angle of all triangles [degree] and their number, in an equilateral or square domain.
struct PatternShape {
  double smallestAngleDeg = 0.0;
  size_t points = 0, triangles = 0;
};
PatternShape shapeOf(Domain domain, const PatternMesh& mesh);

}  // namespace limen::surfaces

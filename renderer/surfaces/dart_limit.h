// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace limen::surfaces {

/// Where a vertex goes at which a single crease ends, and the surface's normal there, of any length. Its own
/// rule is that of a smooth vertex, but the crease's edge has another one, so that limit masks of smooth
/// vertices do not hold. The rules of its one-ring are applied until it no longer moves.
struct DartLimit {
  glm::dvec3 point, normal;
};

/// `edges`: far ends, counter-clockwise; `diagonals`: far corners of the quads between each and the next;
/// `sharp`: place of the crease's edge.
DartLimit catmullClarkDart(glm::dvec3 vertex, std::vector<glm::dvec3> edges,
                           std::vector<glm::dvec3> diagonals, size_t sharp);
/// `own`: weight of each neighbour in the vertex's rule.
DartLimit loopDart(glm::dvec3 vertex, std::vector<glm::dvec3> edges, double own, size_t sharp);

}  // namespace limen::surfaces

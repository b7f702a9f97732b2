// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace limen::surfaces {

/// Triangles with a normal for each of their corners, as PN triangles are made from.
struct BaseMesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;                     ///< counter-clockwise seen from outside
  std::vector<std::array<glm::dvec3, 3>> cornerNormals;  ///< one per triangle, unit
};

/// Merges vertices at the same position (and turns -0 into 0) and drops triangles that lose a corner by it;
/// returns the number of dropped ones. Corner normals, if there are any, are kept.
size_t mergePositions(BaseMesh& mesh);

/// Sets the corner normals of a mesh with merged positions: at each vertex, triangles that are joined by
/// edges with less than `creaseDeg` degrees between their faces share the mean of their face normals,
/// weighted by their angles at the vertex (Thürmer and Wüthrich 1998). 180: smooth everywhere. Edges of one
/// or of more than two triangles are creases. Triangles without area take part in nothing and have their
/// vertex's first normal.
void computeCornerNormals(BaseMesh& mesh, double creaseDeg);

}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// One step of Catmull and Clark's subdivision (Schwarz 2009, section 6.1.5; SC-19). Points of the result:
/// those of the mesh's vertices, then of its faces, then of its edges in the order of MeshTopology::edges().
/// Face f with k vertices becomes k quads in a row, the i-th at its i-th vertex: (vertex, edge to the next,
/// face, edge from the one before). The boundary is a cubic B-spline whose corners with one face stay.
PolygonMesh catmullClark(const PolygonMesh& mesh, Fans fans = Fans::One);
PolygonMesh catmullClark(PolygonMesh mesh, int steps);

/// Where the vertices end up if subdivision goes on for ever. Only for quads and edges that are either smooth
/// or infinitely sharp; throws std::invalid_argument otherwise.
struct LimitPoints {
  std::vector<glm::dvec3> points;
  /// Unit normals of each face at its corners: on creases each side has its own.
  std::vector<std::array<glm::dvec3, 4>> normals;
};
LimitPoints catmullClarkLimit(const PolygonMesh& mesh, Fans fans = Fans::One);

}  // namespace limen::surfaces

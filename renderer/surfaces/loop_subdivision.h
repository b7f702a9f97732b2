// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// One step of Loop's subdivision of triangles (Loop 1987; sharp edges: Hoppe et al. 1994; Schwarz 2009,
/// section 6.1.5; SC-19). Points of the result: those of the mesh's vertices, then of its edges in the order
/// of MeshTopology::edges(). Face f becomes four in a row: at its corners (each begins with the corner), then
/// the middle one, whose i-th vertex lies on the edge after corner i. The boundary is a cubic B-spline whose
/// corners with one face stay. Throws std::invalid_argument if a face is no triangle.
PolygonMesh loop(const PolygonMesh& mesh, Fans fans = Fans::One);
PolygonMesh loop(PolygonMesh mesh, int steps);

/// Where the vertices end up if subdivision goes on for ever. Only for edges that are either smooth or
/// infinitely sharp; throws std::invalid_argument otherwise.
struct LoopLimit {
  std::vector<glm::dvec3> points;
  /// Unit normals of each face at its corners: on creases each side has its own.
  std::vector<std::array<glm::dvec3, 3>> normals;
};
LoopLimit loopLimit(const PolygonMesh& mesh, Fans fans = Fans::One);

}  // namespace limen::surfaces

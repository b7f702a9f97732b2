// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

struct LimitPoint {
  glm::dvec3 position, normal;  ///< normal unit
  int steps = 0;                ///< of subdivision until the point lay in a regular face
};

/// A point of the Catmull-Clark surface at any parameters of one of its quads, whose vertices are (0,0),
/// (1,0), (1,1) and (0,1). The face's surroundings are refined around the point until it lies in a face whose
/// vertices are regular, which is a bicubic B-spline patch (Stam 1998, section 3; his powers of eigenvalues
/// save those steps and nothing else); after `mostSteps` the limit mask of the nearest vertex takes over, its
/// distance being 2^-mostSteps of the face. Sharp edges and boundaries of any kind. Slow: meant for reference
/// (SC-21). All faces around the face must be quads; otherwise refine once first.
LimitPoint catmullClarkPoint(const PolygonMesh& mesh, uint32_t face, double u, double v, int mostSteps = 40);

}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
// The neighbourhood of a vertex as subdivision closes in on it.
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <map>

#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// The faces of `fine` that begin at vertex 0, and their vertices.
inline PolygonMesh ringOfFirst(const PolygonMesh& fine) {
  PolygonMesh ring;
  std::map<uint32_t, uint32_t> places{{0U, 0U}};
  ring.points.push_back(fine.points[0]);
  for (std::vector<uint32_t> face : fine.faces) {
    if (face[0] != 0) continue;
    for (uint32_t& v : face) {
      const auto [at, isNew] = places.try_emplace(v, uint32_t(ring.points.size()));
      if (isNew) ring.points.push_back(fine.points[v]);
      v = at->second;
    }
    ring.faces.push_back(face);
  }
  return ring;
}

/// After so many steps, each seen from the limit of vertex 0 and enlarged, so that rounding stays small.
template <class Subdivide, class Limit>
PolygonMesh enlargedRingOfFirst(PolygonMesh mesh, int steps, const Subdivide& subdivide, const Limit& limit) {
  for (int step = 0; step < steps; ++step) {
    mesh = ringOfFirst(subdivide(mesh));
    const glm::dvec3 centre = limit(mesh).points[0];
    double size = 0.0;
    for (glm::dvec3& p : mesh.points) p -= centre, size = std::max(size, glm::length(p));
    for (glm::dvec3& p : mesh.points) p /= size;
  }
  return mesh;
}

}  // namespace limen::surfaces

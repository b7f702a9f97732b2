// SPDX-License-Identifier: BSD-3-Clause
// What sharp and semi-sharp edges do to the rules of any subdivision scheme (DeRose et al. 1998).
#pragma once

#include <algorithm>

#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// After one step.
inline double nextSharpness(double s) { return s >= kInfinitelySharp ? s : std::max(0.0, s - 1.0); }

/// Ends of the sharp edges at a vertex, at this level or the next, in the order of its ring.
std::vector<uint32_t> sharpEnds(const PolygonMesh& mesh, const MeshTopology& topology, uint32_t vertex,
                                bool next = false);

/// A vertex after one step: rule(ends of sharp edges) of this level, blended with that of the next where
/// edges lose their sharpness on the way. Vertices of one face on a boundary stay.
template <class Rule>
glm::dvec3 refinedVertex(const PolygonMesh& mesh, const MeshTopology& topology, uint32_t v, Rule rule) {
  const VertexRing& ring = topology.rings()[v];
  if (ring.faces.empty() || (!ring.closed && ring.faces.size() == 1)) return mesh.points[v];
  const std::vector<uint32_t> now = sharpEnds(mesh, topology, v), next = sharpEnds(mesh, topology, v, true);
  if (now.size() == next.size()) return rule(now);
  double lost = 0.0;
  for (const uint32_t end : now)
    if (std::find(next.begin(), next.end(), end) == next.end())
      lost += topology.sharpness(mesh, edgeKey(v, end));
  const double share = std::min(1.0, lost / double(now.size() - next.size()));
  return share * rule(now) + (1.0 - share) * rule(next);
}

/// The faces around a vertex, as places in its ring, in runs between sharp edges; all of them where fewer
/// than two edges are sharp.
std::vector<std::vector<size_t>> sectorsOf(const VertexRing& ring, const std::vector<uint32_t>& sharp);

/// The face, which becomes number 0, and all that touch it.
PolygonMesh surroundings(const PolygonMesh& mesh, uint32_t face);

}  // namespace limen::surfaces

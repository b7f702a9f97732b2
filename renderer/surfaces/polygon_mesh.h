// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <vector>

namespace limen::surfaces {

/// Sharpness from which on an edge never becomes smooth.
inline constexpr double kInfinitelySharp = 10.0;

using EdgeKey = std::array<uint32_t, 2>;  ///< vertices, ascending
inline EdgeKey edgeKey(uint32_t a, uint32_t b) { return a < b ? EdgeKey{a, b} : EdgeKey{b, a}; }

/// Control mesh of a subdivision surface. No edge has more than two faces, and the faces around a vertex form
/// one fan. An edge of sharpness s follows the rules of sharp edges for s steps, in the last of them blended
/// (DeRose et al. 1998); edges that are not listed are smooth, those of one face infinitely sharp.
struct PolygonMesh {
  std::vector<glm::dvec3> points;
  std::vector<std::vector<uint32_t>> faces;  ///< three or more vertices each, counter-clockwise from outside
  std::map<EdgeKey, double> sharpness;
};

/// Every face cut into triangles from its first vertex.
PolygonMesh triangulated(PolygonMesh mesh);

/// The faces around a vertex, counter-clockwise: face i lies between the edges to edges[i] and edges[i + 1];
/// of a closed ring the last one lies between the last edge and the first.
struct VertexRing {
  std::vector<uint32_t> faces;
  std::vector<uint32_t> edges;  ///< far ends; one more than faces if the ring is open
  bool closed = true;
};

/// Whether the faces around each vertex must form one fan. Any: a vertex of several fans has an empty ring
/// and does not move; for pieces of meshes, whose outer vertices do not matter.
enum class Fans { One, Any };

/// Connectivity of a mesh. Throws std::invalid_argument if an edge has more than two faces or two in the same
/// direction, or the faces around a vertex form more than one fan.
class MeshTopology {
 public:
  explicit MeshTopology(const PolygonMesh& mesh, Fans fans = Fans::One);
  const std::vector<VertexRing>& rings() const { return rings_; }  ///< by vertex; empty if it has no face
  /// Faces along each edge: to the left of the direction from the smaller to the larger vertex, and to the
  /// right; -1 for none.
  const std::map<EdgeKey, std::array<int32_t, 2>>& edges() const { return edges_; }
  /// Infinite at boundaries.
  double sharpness(const PolygonMesh& mesh, EdgeKey edge) const;

 private:
  std::map<EdgeKey, std::array<int32_t, 2>> edges_;
  std::vector<VertexRing> rings_;
};

}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>

#include "renderer/surfaces/polygon_mesh.h"

namespace limen::surfaces {

/// Why faces are no oriented 2-manifold: the four conditions of Holländer 2013, section 1.1, and two that
/// half-edges need.
enum class MeshFault {
  RepeatedVertex,   ///< a face has the same vertex twice, or fewer than three
  CrowdedEdge,      ///< an edge has more than two faces
  CrowdedBoundary,  ///< a vertex has neither 0 nor 2 boundary edges
  SeveralFans,      ///< the faces around a vertex are not connected by edges
  OpposedFaces,     ///< two faces run along their common edge in the same direction
  UnknownVertex     ///< a face has a vertex that the mesh does not have
};

struct MeshFaultFound {
  MeshFault fault;
  std::string what;  ///< names the face, edge or vertex
};

/// The first fault of a mesh, in the order of MeshFault's first four conditions; none of an oriented
/// manifold.
std::optional<MeshFaultFound> findFault(size_t vertices, const std::vector<std::vector<uint32_t>>& faces);

/// Half-edges of polygons. Half-edge h runs from vertex from[h] to that of next[h], with its face on the
/// left; those of a face follow one another, its first at firstOf[f].
class HalfEdges {
 public:
  static constexpr uint32_t kNone = 0xffffffffU;

  /// `faces` may be a piece of a manifold: vertices whose fans are incomplete do no harm.
  HalfEdges(size_t vertices, const std::vector<std::vector<uint32_t>>& faces);

  std::vector<uint32_t> from, next, previous, face, twin;  ///< twin: kNone at a boundary
  std::vector<uint32_t> firstOf;                           ///< by face
  std::vector<uint32_t> outgoing;  ///< by vertex: a half-edge from it, at a boundary the first of its fan

  uint32_t to(uint32_t h) const { return from[next[h]]; }
  /// The half-edge from the same vertex, one face counter-clockwise; kNone at the fan's end.
  uint32_t turned(uint32_t h) const { return twin[previous[h]]; }

  /// Neighbours counter-clockwise; of an open fan both ends are boundary edges' far ends.
  struct Ring {
    std::vector<uint32_t> ends;
    bool closed = true;
  };
  Ring ring(uint32_t vertex) const;
};

}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/subdivision_stencils.h"

namespace limen::surfaces {

/// Place of a fine vertex in a patch of n segments a side. Triangle: weights of corners 1 and 2, of n, that
/// of corner 0 being n - x - y; quad: steps from corner 0 towards corners 1 and 3.
using Place = std::array<int, 2>;

/// Places of all vertices of a patch of 2^level segments, coarse levels first: those of level l are the first
/// placesAt(corners, l) ones. Scaled to 2^level segments.
std::vector<Place> placesOf(size_t corners, int level);
constexpr uint32_t placesAt(size_t corners, int level) {
  const uint32_t n = 1U << level;
  return corners == 3 ? (n + 1) * (n + 2) / 2 : (n + 1) * (n + 1);
}

/// A face with what its limit surface depends on, cut from a mesh in which no face has more than one
/// extraordinary vertex inside the surface. The face is number 0; its corners are vertices 0, 1, 2 (and 3).
/// Faces beyond a sharp edge are left out where they do not matter.
struct Surroundings {
  RuleMesh mesh;
  std::vector<uint32_t> halfEdges;  ///< by vertex: one from it in the mesh that the piece was cut from
  uint32_t firstHalfEdge = 0;       ///< in that mesh, from vertex 0 along the face
};
/// `rotation`: which of the face's vertices becomes vertex 0.
Surroundings surroundingsOf(const RuleMesh& mesh, const HalfEdges& edges, uint32_t face, size_t rotation,
                            int rings);
/// Surroundings with the same key have the same table.
std::vector<uint32_t> keyOf(const Surroundings& piece);

/// Basis functions of one configuration of surroundings (Bolz and Schroeder 2002; Holländer 2013, section
/// 2.2.1): row by place, one weight of the limit position for each vertex of the piece.
struct BasisTable {
  size_t slots = 0;
  std::vector<double> weights;  ///< slots x rows, rows of a slot in succession
  /// Of two tangents of Loop's surface, in the same order; empty if not asked for.
  std::array<std::vector<double>, 2> tangents;
  double weight(size_t slot, size_t row) const { return weights[slot * (weights.size() / slots) + row]; }
};
BasisTable basisTable(const Surroundings& piece, SubdivisionScheme scheme, int level, bool tangents = false);

}  // namespace limen::surfaces

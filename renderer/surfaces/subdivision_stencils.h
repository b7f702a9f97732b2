// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <utility>

#include "renderer/surfaces/half_edges.h"

namespace limen::surfaces {

enum class SubdivisionScheme {
  Loop,          ///< triangles; Loop 1987
  CatmullClark,  ///< polygons, quads after a step; Catmull and Clark 1978
  Butterfly      ///< closed triangle meshes, interpolating; Dyn et al. 1990, modified by Zorin et al. 1996
};

/// What the rules of subdivision depend on: faces, edges that never become smooth (boundaries among them) and
/// vertices that never move. May be a piece cut from a mesh: an edge of one face that is not sharp is where
/// it was cut.
struct RuleMesh {
  size_t vertices = 0;
  std::vector<std::vector<uint32_t>> faces;
  std::set<EdgeKey> sharp;
  std::set<uint32_t> corners;  ///< three sharp edges or more, or one face at a boundary
  /// Sharpness of edges that become smooth after as many steps; in the last of them rules are blended (DeRose
  /// et al. 1998). None of them is in `sharp`.
  std::map<EdgeKey, double> semiSharp;

  bool isSharp(uint32_t a, uint32_t b) const { return sharp.contains(edgeKey(a, b)); }
};

/// Throws Error where the mesh is no manifold (HOL-01), or the scheme does not take its faces, its boundary
/// or its sharp edges.
RuleMesh ruleMesh(const PolygonMesh& mesh, SubdivisionScheme scheme);

/// After how many steps no edge is semi-sharp any more; 0 if none is.
int stepsUntilSmooth(const PolygonMesh& mesh);

/// Weights of vertices, ascending; they sum to 1, or to 0 for a tangent.
using Stencil = std::vector<std::pair<uint32_t, double>>;

/// One step. Vertices: the mesh's, then (Catmull-Clark) one for each face, then one for each edge in the
/// order of EdgeKey. Faces as loop() and catmullClark() have them.
struct SubdivisionStep {
  RuleMesh mesh;
  std::vector<std::optional<Stencil>> points;  ///< over the mesh's vertices; none where a piece lacks what
                                               ///< the rule asks for
  std::map<EdgeKey, uint32_t> edgePoints;
  uint32_t firstFacePoint = 0;  ///< Catmull-Clark
};
SubdivisionStep refined(const RuleMesh& mesh, SubdivisionScheme scheme);

/// Where a vertex ends up if subdivision goes on for ever; of quads and triangles without semi-sharp edges.
/// None as above.
std::optional<Stencil> limitStencil(const RuleMesh& mesh, const HalfEdges& edges, SubdivisionScheme scheme,
                                    uint32_t vertex);

/// Two tangents of the limit surface at a vertex, whose cross product points outwards, of Loop's scheme.
/// None at corners with several faces.
std::optional<std::array<Stencil, 2>> loopTangents(const RuleMesh& mesh, const HalfEdges& edges,
                                                   uint32_t vertex);

/// Rings of faces around a face on which its limit surface depends.
inline int ringsOf(SubdivisionScheme scheme) { return scheme == SubdivisionScheme::Butterfly ? 2 : 1; }
inline size_t cornersOf(SubdivisionScheme scheme) {
  return scheme == SubdivisionScheme::CatmullClark ? 4 : 3;
}

}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
// Relatives of PN triangles whose tangent planes agree along common sides (Schwarz 2009, section 6.1.3;
// SC-12, SC-13). The thesis describes both in words and prints no formulas: blends and cross derivatives are
// ours.
#pragma once

#include "renderer/surfaces/corner_normals.h"
#include "renderer/surfaces/patch_set.h"
#include "renderer/surfaces/pn_triangles.h"

namespace limen::surfaces {

enum class Smoothing {
  /// Smoothed N-patches: cubic curves run from each point of a side to the opposite corner and are across the
  /// normals of both ends (Nielson's side-vertex method); the three surfaces are blended. Towards the middle
  /// they give way to the PN triangle, more so where the faces beside the side are parallel. Looks at the
  /// triangle alone but for that weight. (Gruen 2005)
  SideVertex,
  /// PNG1 triangles: the PN triangle moved, next to each side, into the mean of its own tangent plane and the
  /// neighbour's (Fünfzig et al. 2008).
  TangentPlanes
};

/// A triangle's surface, which has the boundary of its PN triangle.
class SmoothTriangle {
 public:
  /// What a side needs to know of the triangle beyond it.
  struct Beyond {
    PnTriangle triangle;
    int side = 0;             ///< of that triangle; it runs the other way
    double faceCosine = 0.0;  ///< of the angle between the two flat faces
  };

  /// `beyond`: none at boundaries and creases.
  SmoothTriangle(Smoothing smoothing, const PnBase& base, std::array<std::optional<Beyond>, 3> beyond);

  glm::dvec3 position(double u, double v, double w) const;
  /// Unit, from differences of positions within the domain; at corners the given one.
  glm::dvec3 normal(double u, double v, double w) const;
  /// Unit normal that the tangent planes of both triangles are across, at a share of the way along a side;
  /// null where there is none.
  glm::dvec3 sideNormal(int side, double t) const;

 private:
  glm::dvec3 sideVertex(double u, double v, double w) const;
  glm::dvec3 tangentPlanes(double u, double v, double w) const;

  Smoothing smoothing_;
  PnBase base_;
  PnTriangle triangle_;
  std::array<std::optional<Beyond>, 3> beyond_;
};

/// Those of a mesh with merged positions and corner normals.
std::vector<SmoothTriangle> smoothTriangles(const BaseMesh& mesh, Smoothing smoothing);

/// Such surfaces as patches: each triangle becomes pieces x pieces cubic ones that interpolate it, with a
/// quadratic normal field through its normals. Boundaries are the PN triangles' and shared bit by bit.
/// Neighbours are found.
PatchSet smoothSet(const BaseMesh& mesh, Smoothing smoothing, int pieces);

}  // namespace limen::surfaces

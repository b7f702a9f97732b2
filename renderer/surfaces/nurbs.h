// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/surfaces/patch_set.h"

namespace limen::surfaces {

/// A NURBS surface (Schwarz 2009, section 6.1.4). Knots ascend; there are points + degree + 1 of them in each
/// direction, and the surface is defined from knot `degree` to knot `points`.
struct NurbsSurface {
  int degreeU = 3, degreeV = 3;  ///< 1..kMaxDegree
  std::vector<double> knotsU, knotsV;
  std::vector<glm::dvec4> points;  ///< homogeneous; point (i, j) at i + pointsU() j

  int pointsU() const { return static_cast<int>(knotsU.size()) - degreeU - 1; }
  int pointsV() const { return static_cast<int>(knotsV.size()) - degreeV - 1; }
};

/// The Bézier patches of all spans that are not empty, row by row (SC-15): every knot is inserted until it is
/// as multiple as the degree. Patches beside one another share the control points of their boundary bit by
/// bit. Throws std::invalid_argument: knots that descend or do not match the points, an inner knot of a
/// multiplicity above the degree, where the surface is torn.
PatchSet nurbsPatches(const NurbsSurface& surface);
/// The same of which a region is left; (0, 0) and (1, 1) of its square are the ends of the knots' range.
PatchSet trimmedNurbsPatches(const NurbsSurface& surface, TrimRegion region);

}  // namespace limen::surfaces

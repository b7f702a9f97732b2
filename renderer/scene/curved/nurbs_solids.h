// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/surfaces/nurbs.h"

namespace limen::scene {

/// A sphere as one NURBS surface of degree 2: nine points around the axis, five from pole to pole.
surfaces::NurbsSurface nurbsSphere(glm::dvec3 centre, double radius);

/// A surface of revolution about the vertical line through `foot`: profile of degree p with given knots.
surfaces::NurbsSurface nurbsRevolved(glm::dvec3 foot, int degree, const std::vector<double>& knots,
                                     const std::vector<glm::dvec2>& profile);

/// A wavy sheet of degrees 3 and 5 over the square of half width `half`, with uneven knots, one of them
/// double.
surfaces::NurbsSurface nurbsSheet(glm::dvec3 middle, double half);

struct NurbsSolid {
  std::string name;
  surfaces::PatchSet patches;
  glm::vec3 albedo;
  surfaces::NurbsSurface surface = {};  ///< that the patches come from; of solids that are not trimmed
};
/// What the scene curved/trimmed shows: a sheet with two rings of holes, a ball and a vase with windows.
std::vector<NurbsSolid> trimmedSolids();
/// What the scene curved/nurbs_solids shows.
std::vector<NurbsSolid> nurbsSolids();

}  // namespace limen::scene

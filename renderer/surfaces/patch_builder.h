// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "renderer/surfaces/patch_set.h"

namespace limen::surfaces {

/// Homogeneous point of the given weight; a weight of 0 makes it a direction.
inline glm::dvec4 weighted(glm::dvec3 p, double weight = 1.0) {
  return weight == 0.0 ? glm::dvec4(p, 0.0) : glm::dvec4(p * weight, weight);
}

/// Adds a patch whose (degreeU + 1) (degreeV + 1) control points lie in the order of patch_set.h; `normals`
/// may be empty.
Patch& addRectangle(PatchSet& set, int degreeU, int degreeV, std::span<const glm::dvec4> points,
                    int normalDegree = 0, std::span<const glm::dvec3> normals = {});

/// Adds a triangle of the given degree; `normals` may be empty.
Patch& addTriangle(PatchSet& set, int degree, std::span<const glm::dvec4> points, int normalDegree = 0,
                   std::span<const glm::dvec3> normals = {});

/// Appends all patches; neighbours, if both have them, as well. If both move, with the same period.
void append(PatchSet& to, const PatchSet& from);

/// The set under an affine map. Normals of normal fields are turned by its inverse transpose; a map that
/// mirrors makes all patches face the other way.
PatchSet transformed(PatchSet set, const glm::dmat4& map);

}  // namespace limen::surfaces

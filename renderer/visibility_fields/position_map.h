// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "experiments/base/enum_names.h"

namespace limen::visibility_fields {

/// How positions are spread over the sphere (Gaitatzes 2012, section 4.4.3).
enum class PositionForm {
  Lattice,  ///< subdivided octahedron (after Slater 2002): see map_functions.h
  Grid,     ///< rows and columns in spherical coordinates
  Box       ///< squares on the faces of a cube
};
constexpr EnumNames<PositionForm, 3> enumNames(PositionForm) {
  return {{{{PositionForm::Lattice, "lattice"}, {PositionForm::Grid, "grid"}, {PositionForm::Box, "box"}}}};
}

/// Positions on the unit sphere, and the nearest to any point of it.
class PositionMap {
 public:
  /// `positions`: 82, 290, 1090, 4226 or 16642, those of the lattice with 4, 8, 16, 32 or 64 segments an edge
  /// (two of each on the equator); the other forms have the numbers nearest to it that they allow.
  PositionMap(PositionForm form, int positions);

  PositionForm form() const { return form_; }
  /// Lattice: segments of an edge. Grid: rows. Box: squares along an edge.
  int segments() const { return segments_; }
  const std::vector<glm::vec3>& points() const { return points_; }
  /// Of the nearest point; of several as near, any. `direction`: unit. The same steps as in
  /// field_lookup.glsl.
  int nearest(glm::vec3 direction) const;

 private:
  PositionForm form_;
  int segments_;
  std::vector<glm::vec3> points_;
};

}  // namespace limen::visibility_fields

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/visibility_fields/field_form.h"
#include "renderer/visibility_fields/rigid_objects.h"

namespace limen::visibility_fields {

/// The rays of an object's field by Embree, on all cores, in packets of 16: distances as shares of the
/// sphere's diameter, -1 for none, unrounded: [position][row][column]. Throws std::runtime_error if Embree
/// fails. Source: Gaitatzes 2012, Algorithm 1.
std::vector<float> traceFieldOnCpu(const RigidObject& object, const FieldForm& form);

/// An object's field in main memory, for look-ups on the CPU (Gaitatzes 2012, section 4.6.1). Distances are
/// rounded to the form's bits as in VisibilityFields, but have no normals; with one bit they are means of
/// positions.
class CpuField {
 public:
  /// Made by Embree.
  CpuField(const RigidObject& object, const FieldForm& form);

  /// Distance to the object along the unit direction, -1: none; positions in the world. `slack` as in
  /// field_batch.h; `aimed` as FIELD_AIMED in field_lookup.glsl. Any number of threads at once.
  double distance(glm::dvec3 origin, glm::dvec3 direction, double slack, bool aimed = false) const;
  uint32_t owner() const { return owner_; }
  const Sphere& sphere() const { return sphere_; }
  int64_t rayCount() const { return static_cast<int64_t>(shares_.size()); }

 private:
  /// Stored in the map nearest to a point of the unit sphere: for a direction, or, aimed, for that to a point
  /// within it.
  float shareFrom(glm::vec3 point, glm::vec3 direction) const;
  float shareTowards(glm::vec3 point, glm::vec3 aim) const;
  float shareOf(int map, glm::vec3 direction) const;

  FieldForm form_;
  PositionMap positions_;
  Sphere sphere_;
  uint32_t owner_;
  std::vector<float> shares_;
};

/// Mean distance between neighbouring rays of a field at the distance of a radius, in radii: neighbouring
/// positions are sqrt(4 pi / positions) apart on average, and directions, whose discs have the area pi
/// together, sqrt(pi) / directions.
double fieldSpacing(const FieldForm& form);

}  // namespace limen::visibility_fields

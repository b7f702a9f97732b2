// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/scene/scene.h"

namespace limen::references {

/// A scene's triangles with the coordinates that the GPU holds: float, relative to the anchor. References see
/// the same surfaces as the techniques, rounding included.
class Triangles {
 public:
  Triangles(const scene::Scene& scene, glm::dvec3 anchor);

  size_t count() const { return indices_.size(); }
  glm::dvec3 corner(size_t triangle, int which) const { return vertices_[indices_[triangle][which]]; }
  const std::vector<glm::vec3>& vertices() const { return vertices_; }
  const std::vector<glm::uvec3>& indices() const { return indices_; }

  /// Distance from a triangle's plane within which a point of another triangle counts as lying in it.
  /// Rounding moves a vertex by at most sqrt(3) 2^-24 of the largest coordinate; both planes may have moved,
  /// which gives 4 * 2^-24.
  double planeTolerance() const { return planeTolerance_; }

 private:
  std::vector<glm::vec3> vertices_;
  std::vector<glm::uvec3> indices_;
  double planeTolerance_ = 0.0;
};

/// Share of the way from a receiver to the light's plane that an occluder may not enter: anything in the
/// light's plane up to rounding hides nothing. All references that work on triangles use it.
inline constexpr double kLightMargin = 1e-6;

/// Hits of shadow rays nearer than this many plane tolerances are tested again in double precision. An origin
/// rounded to float can turn a miss into a hit as far away as the rounding (less than a tolerance) over the
/// sine of the angle between ray and surface; 32768 covers angles down to 3e-5, and is still less than a
/// hundredth of the scene.
inline constexpr double kNearTolerances = 32768.0;

}  // namespace limen::references

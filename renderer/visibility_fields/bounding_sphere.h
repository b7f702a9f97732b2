// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>
#include <vector>

namespace limen::visibility_fields {

struct Sphere {
  glm::dvec3 centre{0.0};
  double radius = 0.0;
};

/// A sphere that contains all points, close to the smallest one: its centre approaches the farthest point by
/// ever shorter steps (Bădoiu and Clarkson 2003). Radius 0 for no point or one.
Sphere boundingSphere(const std::vector<glm::dvec3>& points);

}  // namespace limen::visibility_fields

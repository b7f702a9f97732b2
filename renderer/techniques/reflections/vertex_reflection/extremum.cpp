// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/extremum.h"

#include <cmath>

namespace limen::reflections {

Extremum extremumAt(const StarSurface& surface, glm::dvec3 direction, glm::dvec3 eye, glm::dvec3 vertex,
                    double stepShare) {
  const glm::dvec3 axis = std::abs(direction.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 x = glm::normalize(glm::cross(direction, axis)), y = glm::cross(direction, x);
  const auto length = [&](double i, double j) {
    const glm::dvec3 u = glm::normalize(direction + stepShare * (i * x + j * y));
    const glm::dvec3 point = surface(u).radius * u;
    return glm::length(point - eye) + glm::length(point - vertex);
  };
  const double middle = length(0.0, 0.0);
  const double xx = length(1.0, 0.0) - 2.0 * middle + length(-1.0, 0.0);
  const double yy = length(0.0, 1.0) - 2.0 * middle + length(0.0, -1.0);
  const double xy = 0.25 * (length(1.0, 1.0) - length(1.0, -1.0) - length(-1.0, 1.0) + length(-1.0, -1.0));
  // Of opposite or vanishing curvatures.
  if (!(xx * yy - xy * xy > 0.0)) return Extremum::Between;
  return xx > 0.0 ? Extremum::Minimum : Extremum::Maximum;
}

}  // namespace limen::reflections

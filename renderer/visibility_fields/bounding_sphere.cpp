// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/bounding_sphere.h"

#include <cmath>

namespace limen::visibility_fields {
namespace {

constexpr int kSteps = 128;

}  // namespace

Sphere boundingSphere(const std::vector<glm::dvec3>& points) {
  Sphere best;
  if (points.empty()) return best;
  glm::dvec3 low = points[0], high = points[0];
  for (const glm::dvec3 p : points) low = glm::min(low, p), high = glm::max(high, p);
  glm::dvec3 centre = low + 0.5 * (high - low);
  for (int step = 0; step < kSteps; ++step) {
    double squared = -1.0;
    glm::dvec3 farthest = centre;
    for (const glm::dvec3 p : points) {
      const glm::dvec3 d = p - centre;
      if (const double length = glm::dot(d, d); length > squared) squared = length, farthest = p;
    }
    if (const double radius = std::sqrt(squared); step == 0 || radius < best.radius) best = {centre, radius};
    centre += (farthest - centre) / double(step + 3);
  }
  return best;
}

}  // namespace limen::visibility_fields

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/ray_roots.h"

#include <algorithm>
#include <cmath>

namespace limen::surfaces {

PatchOnRay onRay(const PatchSet& set, const Patch& patch, const Ray& ray) {
  const glm::dvec3 d = ray.direction, a = glm::abs(d);
  // Perpendicular to the smallest component, so that the cross product is long.
  const glm::dvec3 axis = a.x <= a.y && a.x <= a.z ? glm::dvec3(1, 0, 0)
                          : a.y <= a.z             ? glm::dvec3(0, 1, 0)
                                                   : glm::dvec3(0, 0, 1);
  const glm::dvec3 n1 = glm::normalize(glm::cross(d, axis)), n2 = glm::cross(d, n1);
  PatchOnRay out{patch.domain, patch.degreeU, patch.degreeV, {}};
  out.points.reserve(static_cast<size_t>(patch.points()));
  for (uint32_t i = 0; i < static_cast<uint32_t>(patch.points()); ++i) {
    const glm::dvec4& p = set.points[patch.firstPoint + i];
    const glm::dvec3 relative = glm::dvec3(p) - p.w * ray.origin;
    out.points.emplace_back(glm::dot(n1, relative), glm::dot(n2, relative), glm::dot(d, relative), p.w);
  }
  return out;
}

}  // namespace limen::surfaces

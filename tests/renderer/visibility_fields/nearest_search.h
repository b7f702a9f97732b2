// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <glm/glm.hpp>
#include <random>
#include <vector>

namespace limen::visibility_fields {

/// Uniform on the sphere; every 16th with a coordinate of 0, every 64th along an axis.
inline glm::dvec3 randomPoint(std::mt19937_64& engine, int number) {
  std::normal_distribution<> normal;
  glm::dvec3 p(normal(engine), normal(engine), normal(engine));
  if (number % 16 == 0) p[number / 16 % 3] = 0.0;
  if (number % 64 == 0) p[(number / 16 + 1) % 3] = 0.0;
  return glm::normalize(p);
}

/// Points in order of z: those farther away in z than the nearest so far cannot be nearer.
class Search {
 public:
  explicit Search(const std::vector<glm::vec3>& points) : points_(points.begin(), points.end()) {
    std::sort(points_.begin(), points_.end(), [](glm::dvec3 a, glm::dvec3 b) { return a.z < b.z; });
  }
  double nearestDistance(glm::dvec3 p) const {
    const auto start =
        std::lower_bound(points_.begin(), points_.end(), p.z, [](glm::dvec3 a, double z) { return a.z < z; });
    double best = 4.0;
    for (auto at = start; at != points_.end() && at->z - p.z < best; ++at)
      best = std::min(best, glm::distance(*at, p));
    for (auto at = start; at != points_.begin() && p.z - (at - 1)->z < best; --at)
      best = std::min(best, glm::distance(*(at - 1), p));
    return best;
  }

 private:
  std::vector<glm::dvec3> points_;
};

}  // namespace limen::visibility_fields

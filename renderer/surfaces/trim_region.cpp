// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/trim_region.h"

#include <algorithm>
#include <cmath>

namespace limen::surfaces {
namespace {

double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

}  // namespace

double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along);
  const double t = length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::length(p - a - t * along);
}

bool TrimRegion::contains(glm::dvec2 at) const {
  bool inside = false;
  forSegments(*this, [&](glm::dvec2 a, glm::dvec2 b) {
    if ((a.y > at.y) == (b.y > at.y)) return;
    if (at.x < a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
  });
  return inside;
}

double TrimRegion::area() const {
  // A loop inside an odd number of others is a hole.
  double sum = 0.0;
  for (size_t i = 0; i < loops.size(); ++i) {
    double twice = 0.0;
    for (size_t k = 0; k < loops[i].size(); ++k)
      twice += cross(loops[i][k], loops[i][(k + 1) % loops[i].size()]);
    TrimRegion others = *this;
    others.loops.erase(others.loops.begin() + static_cast<long>(i));
    sum += 0.5 * std::abs(twice) * (others.contains(loops[i][0]) ? -1.0 : 1.0);
  }
  return sum;
}

std::vector<glm::dvec2> trimLoop(std::span<const std::vector<glm::dvec3>> curves, int segments) {
  std::vector<glm::dvec2> out;
  for (const std::vector<glm::dvec3>& curve : curves)
    for (int i = 0; i < segments; ++i) {
      const double t = double(i) / segments;
      std::vector<glm::dvec3> points = curve;
      for (size_t n = points.size() - 1; n > 0; --n)
        for (size_t k = 0; k < n; ++k) points[k] = glm::mix(points[k], points[k + 1], t);
      out.push_back(glm::dvec2(points[0]) / points[0].z);
    }
  return out;
}

std::vector<glm::dvec2> trimCircle(glm::dvec2 centre, double radius, int segments) {
  std::vector<std::vector<glm::dvec3>> quarters;
  for (int q = 0; q < 4; ++q) {
    const double start = 0.5 * M_PI * q;
    const auto at = [&](double turn, double reach, double weight) {
      const glm::dvec2 p = centre + radius * reach * glm::dvec2(std::cos(turn), std::sin(turn));
      return glm::dvec3(p * weight, weight);
    };
    quarters.push_back({at(start, 1.0, 1.0), at(start + 0.25 * M_PI, std::sqrt(2.0), std::sqrt(0.5)),
                        at(start + 0.5 * M_PI, 1.0, 1.0)});
  }
  return trimLoop(quarters, segments);
}

}  // namespace limen::surfaces

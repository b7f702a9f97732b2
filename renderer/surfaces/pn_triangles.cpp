// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/pn_triangles.h"

#include <algorithm>
#include <cmath>

namespace limen::surfaces {
namespace {

/// Below this sine of the angle between the two normals at a crease its direction means nothing.
constexpr double kNoCrease = 1e-4;

/// Control point next to `a` on the side from a to b.
glm::dvec3 tangentPoint(glm::dvec3 a, glm::dvec3 b, glm::dvec3 normal,
                        const std::optional<glm::dvec3>& otherNormal) {
  if (otherNormal) {
    const glm::dvec3 crease = glm::cross(normal, *otherNormal);
    if (const double length = glm::length(crease); length >= kNoCrease) {
      // The thesis' formula holds for a unit tangent.
      const glm::dvec3 tangent = crease / length;
      return a + glm::dot(b - a, tangent) * tangent / 3.0;
    }
  }
  return (2.0 * a + b - glm::dot(b - a, normal) * normal) / 3.0;
}

/// Projection of p onto the plane through a.
glm::dvec3 ontoPlane(glm::dvec3 p, glm::dvec3 a, glm::dvec3 normal) {
  return p - glm::dot(p - a, normal) * normal;
}

double distanceFromEdge(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b) {
  const glm::dvec3 edge = b - a;
  const double squared = glm::dot(edge, edge);
  const double t = squared > 0.0 ? std::clamp(glm::dot(p - a, edge) / squared, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + t * edge));
}

}  // namespace

glm::dvec3 pnMiddleNormal(glm::dvec3 a, glm::dvec3 b, glm::dvec3 normalA, glm::dvec3 normalB,
                          const PnSettings& settings) {
  const glm::dvec3 sum = normalA + normalB, edge = b - a, linear = 0.5 * sum;
  const double squared = glm::dot(edge, edge);
  if (squared == 0.0 || settings.normals == PnNormals::Linear) return linear;
  const glm::dvec3 tilt = glm::dot(sum, edge) / squared * edge, h = sum - 2.0 * tilt;
  const double length = glm::length(h);
  // Opposed normals: what is left of their sum is rounding.
  if (length < 1e-12) return linear;
  const glm::dvec3 scaled = settings.halfH ? 0.5 * h : h;
  switch (settings.normals) {
    case PnNormals::Vlachos:
      return h / length;
    case PnNormals::VanOverveldWyvill:
      return 0.5 * (sum - 3.0 * tilt);
    case PnNormals::Farin:
      return 1.5 * scaled - 0.25 * sum;
    case PnNormals::CorrectedFarin:
      return 2.0 * scaled - 0.5 * sum;
    case PnNormals::LeeJen:
      return glm::dot(normalA, edge) * glm::dot(normalB, edge) > 0.0 ? h / length : linear;
    case PnNormals::Linear:
      break;
  }
  return linear;
}

PnTriangle pnTriangle(const PnBase& base, const PnSettings& settings) {
  const auto& p = base.positions;
  const auto& n = base.normals;
  // Of side s: the points next to its first and second end.
  std::array<glm::dvec3, 3> first, second, middle;
  for (size_t s = 0; s < 3; ++s) {
    const size_t t = (s + 1) % 3;
    first[s] = tangentPoint(p[s], p[t], n[s], base.creases[s][0]);
    second[s] = tangentPoint(p[t], p[s], n[t], base.creases[s][1]);
    if (settings.tension != 0.0) {
      first[s] = glm::mix(first[s], p[s], settings.tension);
      second[s] = glm::mix(second[s], p[t], settings.tension);
    }
    middle[s] = pnMiddleNormal(p[s], p[t], n[s], n[t], settings);
  }
  const glm::dvec3 centre =
      (first[0] + second[0] + first[1] + second[1] + first[2] + second[2]) / 4.0 - (p[0] + p[1] + p[2]) / 6.0;
  // Sides run u -> v, v -> w, w -> u.
  return {{p[0], first[0], second[2], second[0], centre, first[2], p[1], first[1], second[1], p[2]},
          {n[0], middle[0], middle[2], n[1], middle[1], n[2]}};
}

double pnTangentDistance(const PnTriangle& triangle) {
  const auto& b = triangle.points;
  return std::max({distanceFromEdge(b[1], b[0], b[6]), distanceFromEdge(b[3], b[0], b[6]),
                   distanceFromEdge(b[7], b[6], b[9]), distanceFromEdge(b[8], b[6], b[9]),
                   distanceFromEdge(b[5], b[9], b[0]), distanceFromEdge(b[2], b[9], b[0])});
}

std::array<glm::dvec3, 6> phongTriangle(const PnBase& base, double alpha) {
  const auto& p = base.positions;
  const auto& n = base.normals;
  const auto middle = [&](size_t a, size_t b) {
    const glm::dvec3 projected = 0.5 * (ontoPlane(p[b], p[a], n[a]) + ontoPlane(p[a], p[b], n[b]));
    return (1.0 - alpha) * (0.5 * (p[a] + p[b])) + alpha * projected;
  };
  return {p[0], middle(0, 1), middle(0, 2), p[1], middle(1, 2), p[2]};
}

}  // namespace limen::surfaces

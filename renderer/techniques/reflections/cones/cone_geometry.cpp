// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/cones/cone_geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace limen::techniques {
namespace {

double determinant(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) { return glm::dot(a, glm::cross(b, c)); }
double cross(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Ray2 {
  glm::dvec2 origin, direction;
};

/// A ray from `eye` reflected at the circle curvature (x^2 + y^2) + 2 y = 0, a line where the curvature is 0;
/// none if it misses it.
std::optional<Ray2> reflectedAtCircle(glm::dvec2 eye, glm::dvec2 direction, double curvature) {
  const double a = curvature, b = 2.0 * (curvature * glm::dot(eye, direction) + direction.y);
  const double c = curvature * glm::dot(eye, eye) + 2.0 * eye.y;
  const double discriminant = b * b - 4.0 * a * c;
  if (!(discriminant >= 0.0)) return std::nullopt;
  // Where the ray meets the side that the normal points to, by the form that does not cancel.
  const double root = std::sqrt(discriminant);
  const double along = b > 0.0 ? (-b - root) / (2.0 * a) : 2.0 * c / (root - b);
  if (!(along > 0.0)) return std::nullopt;
  const glm::dvec2 point = eye + along * direction;
  const glm::dvec2 normal = glm::normalize(glm::dvec2(curvature * point.x, curvature * point.y + 1.0));
  if (!(glm::dot(direction, normal) < 0.0)) return std::nullopt;
  return Ray2{point, glm::reflect(direction, normal)};
}

glm::dvec2 turned(glm::dvec2 v, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

}  // namespace

double meanCurvature(const std::array<glm::dvec3, 3>& points, const std::array<glm::dvec3, 3>& normals,
                     double u, double v) {
  const glm::dvec3 pointU = points[1] - points[0], pointV = points[2] - points[0];
  const glm::dvec3 normalU = normals[1] - normals[0], normalV = normals[2] - normals[0];
  const glm::dvec3 normal = normals[0] + u * normalU + v * normalV;
  const double divisor = 2.0 * glm::length(normal) * determinant(pointU, pointV, normal);
  if (divisor == 0.0) return 0.0;
  const double out = (determinant(normalU, pointV, normal) + determinant(pointU, normalV, normal)) / divisor;
  return std::isfinite(out) ? out : 0.0;
}

ReflectedCone reflectParaxially(double distance, double cosIncidence, double curvature, double halfAngle) {
  const double bend = 2.0 * curvature / cosIncidence, vergence = 1.0 / distance + bend;
  ReflectedCone out;
  out.halfAngle = halfAngle * std::abs(1.0 + bend * distance);
  out.apexDistance = vergence == 0.0 ? kInfinity : 1.0 / vergence;
  if (vergence < 0.0) out.kind = ReflectedCone::Kind::Double;
  if (vergence == 0.0) out.kind = ReflectedCone::Kind::Parallel;
  return out;
}

ReflectedCone reflectEdgeRays(double distance, double cosIncidence, double curvature, double halfAngle) {
  // The point is the origin, the normal (0, 1), and the eye to the left.
  const glm::dvec2 towardsEye(-std::sqrt(std::max(1.0 - cosIncidence * cosIncidence, 0.0)), cosIncidence);
  const glm::dvec2 eye = distance * towardsEye;
  const auto left = reflectedAtCircle(eye, turned(-towardsEye, -halfAngle), curvature);
  const auto right = reflectedAtCircle(eye, turned(-towardsEye, halfAngle), curvature);
  ReflectedCone out;
  if (!left || !right) {
    out.kind = ReflectedCone::Kind::Grazing;
    return out;
  }
  // Turning the ray from the eye against the clock turns its reflection with it.
  const double angle =
      std::atan2(cross(right->direction, left->direction), glm::dot(left->direction, right->direction));
  out.halfAngle = 0.5 * std::abs(angle);
  const double sine = cross(left->direction, right->direction);
  if (sine == 0.0) {
    out.kind = ReflectedCone::Kind::Parallel;
    out.apexDistance = kInfinity;
    return out;
  }
  const glm::dvec2 between = right->origin - left->origin;
  const double alongLeft = cross(between, right->direction) / sine,
               alongRight = cross(between, left->direction) / sine;
  const glm::dvec2 apex = left->origin + alongLeft * left->direction;
  out.apexDistance = -glm::dot(apex, glm::normalize(left->direction + right->direction));
  if (alongLeft > 0.0 || alongRight > 0.0) out.kind = ReflectedCone::Kind::Double;
  return out;
}

double combinedHalfAngle(double reflected, double glossRad) {
  return std::min(reflected + glossRad, kWidestCone);
}

std::vector<glm::dvec2> projectedToDisk(const Cone& cone, const std::array<glm::dvec3, 3>& triangle) {
  // Any frame around the axis: overlaps do not depend on it.
  const glm::dvec3 other =
      std::abs(cone.axis.x) < 0.6 ? glm::dvec3(1.0, 0.0, 0.0) : glm::dvec3(0.0, 1.0, 0.0);
  const glm::dvec3 x = glm::normalize(glm::cross(cone.axis, other)), y = glm::cross(cone.axis, x);
  std::array<glm::dvec3, 3> seen;
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 from = triangle[i] - cone.apex;
    seen[i] = {glm::dot(from, x), glm::dot(from, y), glm::dot(from, cone.axis)};
    if (!std::isfinite(seen[i].x + seen[i].y + seen[i].z)) return {};
  }
  std::vector<glm::dvec2> out;
  const double radius = std::tan(cone.halfAngle);
  const auto add = [&](glm::dvec3 p) { out.emplace_back(glm::dvec2(p.x, p.y) / (p.z * radius)); };
  for (size_t i = 0; i < 3; ++i) {
    const glm::dvec3 from = seen[i], to = seen[(i + 1) % 3];
    const bool isBeyond = from.z >= cone.nearPlane;
    if (isBeyond) add(from);
    if (isBeyond != (to.z >= cone.nearPlane)) {
      glm::dvec3 cut = glm::mix(from, to, (cone.nearPlane - from.z) / (to.z - from.z));
      cut.z = cone.nearPlane;
      add(cut);
    }
  }
  return out;
}

}  // namespace limen::techniques

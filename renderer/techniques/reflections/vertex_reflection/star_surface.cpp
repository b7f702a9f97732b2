// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/star_surface.h"

#include <cmath>

namespace limen::reflections {

RadialPoint radialPoint(glm::dvec3 direction, double f, glm::dvec3 slope) {
  // The part of the slope along the direction leaves the sphere of directions.
  return {f, (slope - glm::dot(slope, direction) * direction) / f};
}

RadialPoint radialPointOfNormal(glm::dvec3 direction, double radius, glm::dvec3 normal) {
  const double along = glm::dot(normal, direction);
  if (!(std::abs(along) > 1e-12)) return {};
  return {radius, direction - normal / along};
}

glm::dvec3 outwardNormal(glm::dvec3 direction, const RadialPoint& point) {
  return glm::normalize(direction - point.gradient);
}

StarSurface sphereSurface(double radius) {
  return [radius](glm::dvec3) { return RadialPoint{radius, glm::dvec3(0.0)}; };
}

StarSurface ellipsoidSurface(glm::dvec3 semiAxes) {
  const glm::dvec3 weights = 1.0 / (semiAxes * semiAxes);
  return [weights](glm::dvec3 direction) {
    const glm::dvec3 weighted = weights * direction;
    const double radius = 1.0 / std::sqrt(glm::dot(weighted, direction));
    return radialPoint(direction, radius, -radius * radius * radius * weighted);
  };
}

StarSurface bumpySurface(double radius, double height, double frequency) {
  return [=](glm::dvec3 direction) {
    const double x = frequency * direction.x, y = frequency * direction.y;
    const double f = radius * (1.0 + height * std::cos(x) * std::cos(y));
    const glm::dvec3 slope(-std::sin(x) * std::cos(y), -std::cos(x) * std::sin(y), 0.0);
    return radialPoint(direction, f, radius * height * frequency * slope);
  };
}

}  // namespace limen::reflections

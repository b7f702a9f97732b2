// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <glm/glm.hpp>

namespace limen::reflections {

/// Where a star-shaped surface lies along one direction from its centre (Roger 2008, section 2.2.1).
struct RadialPoint {
  double radius = 0.0;  ///< > 0; 0: the surface has no point in this direction
  /// Gradient in space, at the surface, of the radius as a function of direction alone (constant along rays
  /// from the centre): perpendicular to the direction, no unit. The surface's normal is parallel to direction
  /// - gradient.
  glm::dvec3 gradient{0.0};
};

/// The point of a surface in a direction (unit) from its centre, the origin.
using StarSurface = std::function<RadialPoint(glm::dvec3 direction)>;

/// Radius > 0.
StarSurface sphereSurface(double radius);
/// Semi-axes along x, y, z, > 0.
StarSurface ellipsoidSurface(glm::dvec3 semiAxes);
/// radius (1 + height cos(frequency x) cos(frequency y)) with x, y of the unit direction; |height| < 1.
StarSurface bumpySurface(double radius, double height, double frequency);
/// Of a radius that is known, with its gradient, only as a function `f` of the unit direction: `slope` is the
/// gradient of any smooth extension of f to the neighbourhood of the unit sphere.
RadialPoint radialPoint(glm::dvec3 direction, double f, glm::dvec3 slope);
/// Of a surface whose point at `radius` has the unit normal `normal`, which need not be that of one side;
/// radius 0 if the normal is perpendicular to the direction.
RadialPoint radialPointOfNormal(glm::dvec3 direction, double radius, glm::dvec3 normal);
/// Unit, pointing away from the centre.
glm::dvec3 outwardNormal(glm::dvec3 direction, const RadialPoint& point);

}  // namespace limen::reflections

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace limen::techniques {

/// Mean curvature [1 / world unit] of a triangle with vertex normals at barycentric coordinates (1 - u - v,
/// u, v), by its edges and the differences of its normals (Theisel et al. 2004; Roger 2008, section 5.2;
/// formula reconstructed). Outward normals: a sphere of radius R has 1 / R, a cylinder 1 / (2 R), a symmetric
/// saddle 0. 0 where the triangle or the normal has no direction.
double meanCurvature(const std::array<glm::dvec3, 3>& points, const std::array<glm::dvec3, 3>& normals,
                     double u, double v);

/// What a narrow cone from the eye becomes at a reflector that is replaced by the sphere of its mean
/// curvature.
struct ReflectedCone {
  enum class Kind {
    Diverging,  ///< from an apex behind the reflector
    Parallel,   ///< apex at infinity
    /// Converges to an apex in front of the reflector and diverges beyond, or meets the reflector in part
    /// only: not supported (Roger 2008, figure 5.3)
    Double,
    Grazing  ///< an edge of the cone misses the reflector
  };
  Kind kind = Kind::Diverging;
  double halfAngle = 0.0;  ///< [rad], >= 0
  double apexDistance =
      0.0;  ///< of the apex behind the point, against the reflected direction; < 0: in front
};

/// `distance` from the eye to the point, `cosIncidence` in (0, 1], `curvature` positive where convex,
/// `halfAngle` of the eye's cone. Paraxial (reconstructed): the half-angle times 1 + 2 curvature distance /
/// cos, the apex at 1 / (1 / distance + 2 curvature / cos). The plane of incidence alone counts, as in the
/// thesis; across it the factor is 2 curvature cos.
ReflectedCone reflectParaxially(double distance, double cosIncidence, double curvature, double halfAngle);

/// The same by the two rays at the cone's edges, reflected at the circle in the plane of incidence: exact
/// there, and to be preferred where halfAngle x distance x curvature is not small. `apexDistance` is measured
/// along the middle of the reflected rays' directions.
ReflectedCone reflectEdgeRays(double distance, double cosIncidence, double curvature, double halfAngle);

/// Cone of everything that may contribute to a pixel: the reflected cone widened by the gloss (Roger 2008,
/// figure 5.4).
struct Cone {
  glm::dvec3 apex{0.0}, axis{0.0, 0.0, 1.0};  ///< axis of unit length
  double halfAngle = 0.0;                     ///< [rad], below pi / 2
  double nearPlane = 0.0;                     ///< distance from the apex along the axis, > 0
};
/// Half-angles from `kWidestCone` on cannot be projected onto a plane and are clamped to it.
inline constexpr double kWidestCone = 1.5;
double combinedHalfAngle(double reflected, double glossRad);

/// The part of a triangle beyond the cone's near plane, projected so that the cone becomes the unit disk
/// around 0; none to four corners. Does not depend on the scale of the scene. Empty where a corner is not
/// finite.
std::vector<glm::dvec2> projectedToDisk(const Cone& cone, const std::array<glm::dvec3, 3>& triangle);

}  // namespace limen::techniques

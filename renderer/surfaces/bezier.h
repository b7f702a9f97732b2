// SPDX-License-Identifier: BSD-3-Clause
// Evaluation of polynomial and rational Bézier patches and triangles, degrees 1 to kMaxDegree (Schwarz 2009,
// section 6.1.1 to 6.1.3; SC-01 to SC-03, SC-05).
#pragma once

#include "renderer/surfaces/domain_point.h"

namespace limen::surfaces {

/// Value and derivatives with respect to u and v at a point of the domain. Of a triangle, w = 1 - u - v
/// follows them: `u` is the derivative along w -> u, `v` along w -> v.
template <class Vector>
struct Jet {
  Vector p{0.0}, u{0.0}, v{0.0}, uu{0.0}, uv{0.0}, vv{0.0};

  /// Derivative along a direction of the domain, and the mixed one along two.
  Vector along(glm::dvec2 d) const { return u * d.x + v * d.y; }
  Vector along(glm::dvec2 d, glm::dvec2 e) const {
    return uu * (d.x * e.x) + uv * (d.x * e.y + d.y * e.x) + vv * (d.y * e.y);
  }
};
using SurfaceJet = Jet<glm::dvec3>;
using HomogeneousJet = Jet<glm::dvec4>;

/// Directions along the sides of a triangle's domain, in (u, v): side s runs from corner s to corner s + 1.
inline constexpr std::array<glm::dvec2, 3> kTriangleSides = {glm::dvec2{-1.0, 1.0}, {0.0, -1.0}, {1.0, 0.0}};

/// How many orders of derivatives are computed; the others are 0.
enum class Order { Position, First, Second };

/// In homogeneous coordinates; polynomial, so finite whatever the weights.
HomogeneousJet homogeneousJet(const PatchSet& set, const Patch& patch, const DomainPoint& at,
                              Order order = Order::Second);

/// World units; quotient rules of rational surfaces. Not finite where the weights sum to 0.
SurfaceJet evaluate(const PatchSet& set, const Patch& patch, const DomainPoint& at,
                    Order order = Order::Second);
SurfaceJet project(const HomogeneousJet& jet);

/// A Bézier triangle of degree n, 0 <= n <= kMaxDegree, whose points lie in the order of patch_set.h.
template <class Vector>
Jet<Vector> triangleJet(int n, const Vector* points, const DomainPoint& at, Order order);
extern template HomogeneousJet triangleJet(int, const glm::dvec4*, const DomainPoint&, Order);
extern template SurfaceJet triangleJet(int, const glm::dvec3*, const DomainPoint&, Order);

/// Length of the diagonal of the box of the patch's control points, directions left out; world units.
double controlDiagonal(const PatchSet& set, const Patch& patch);

/// Control points of a side in its direction; their number is the side's degree + 1.
std::vector<glm::dvec4> sidePoints(const PatchSet& set, const Patch& patch, int side);

/// Whether all control points of a side are in the same place but for rounding; weights may differ. Positions
/// along it differ by rounding as well.
bool isCollapsed(const PatchSet& set, const Patch& patch, int side);

}  // namespace limen::surfaces

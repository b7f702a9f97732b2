// SPDX-License-Identifier: BSD-3-Clause
// All intersections of a ray with a patch, by three methods that have nothing in common but the ray's
// coordinates: Bézier clipping (Nishita et al. 1990; SC-33), which is fast, subdivision by convex hulls, and
// interval arithmetic (SC-28), which is proven to miss none.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/surfaces/bezier.h"

namespace limen::surfaces {

struct Ray {
  glm::dvec3 origin{0.0};
  glm::dvec3 direction{0.0, 0.0, -1.0};  ///< unit
};

/// A patch in a ray's coordinates: x and y are distances from two perpendicular planes through the ray, z is
/// measured along it; homogeneous. Roots are where x = y = 0. (Schwarz 2009, section 6.5)
struct PatchOnRay {
  Domain domain = Domain::Rectangle;
  int degreeU = 3, degreeV = 3;
  std::vector<glm::dvec4> points;
};
PatchOnRay onRay(const PatchSet& set, const Patch& patch, const Ray& ray);

struct RayRoot {
  double t = 0.0;  ///< distance along the ray
  DomainPoint at;
};

/// Sums of what root finding took.
struct RootCounts {
  int64_t steps = 0;         ///< clips, or parts looked at
  int64_t splits = 0;        ///< halvings because clipping did not get on
  int64_t duplicates = 0;    ///< roots found more than once
  int64_t falseReports = 0;  ///< parts that shrank to a point that is not a root
  int64_t unproven = 0;      ///< roots of interval arithmetic: within the tolerance, but they need not cross
};

/// Roots with t > 0, nearest first, of a patch whose weights are positive. Every place where the surface
/// crosses the ray is reported, and every report lies within `tolerance` of the ray: parts are left out only
/// if the hull of their control points misses it. A surface that touches the ray without crossing it may be
/// reported several times.
std::vector<RayRoot> hullRoots(const PatchOnRay& patch, double tolerance, RootCounts* counts = nullptr);

/// The same by interval arithmetic. A box of the domain is left out only if it is proven to hold no root, all
/// rounding included; a root is proven to exist, or is one of a surface that touches the ray or nearly so,
/// within `tolerance`.
std::vector<RayRoot> intervalRoots(const PatchOnRay& patch, double tolerance, RootCounts* counts = nullptr);

struct ClipSettings {
  double width = 1e-10;  ///< of a part of the domain that counts as a point
  double split = 0.8;    ///< a clip that leaves more than this share is followed by a halving
};
/// The same by Bézier clipping of a rectangle (triangles: triangleAsRectangle()). Reports farther than
/// `tolerance` from the ray are dropped and counted, and so are duplicates.
std::vector<RayRoot> clippedRoots(const PatchOnRay& rectangle, double tolerance,
                                  const ClipSettings& settings = {}, RootCounts* counts = nullptr);

}  // namespace limen::surfaces

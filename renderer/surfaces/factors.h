// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "experiments/base/enum_names.h"
#include "renderer/surfaces/factor_rules.h"
#include "renderer/surfaces/patterns.h"

namespace limen::surfaces {

/// Which pair of step sizes satisfies a bound on the deviation of a rectangle (Schwarz 2009, section 7.4.2).
enum class FactorRule { Filip = kRuleFilip, AbiEzziShirman = kRuleAbiEzziShirman, Guthe = kRuleGuthe };
constexpr EnumNames<FactorRule, 3> enumNames(FactorRule) {
  return {{{{FactorRule::AbiEzziShirman, "abi_ezzi_shirman"},
            {FactorRule::Filip, "filip"},
            {FactorRule::Guthe, "guthe"}}}};
}

/// Bounds of second derivatives of a rectangular patch from its control points. Of a rational patch those of
/// Zheng and Sederberg 2000 (equation 7.5 of the thesis), which bound the deviation as those of a polynomial
/// one of tolerance eps * weight: from a point of the surface to the point of the triangle with the same
/// homogeneous weights, so the distance to the triangle. At equal parameters the distance may be larger. A
/// patch with equal weights gives the polynomial bounds times its weight.
struct DerivativeBounds {
  double uu = 0.0, uv = 0.0, vv = 0.0;
  double weight = 1.0;  ///< smallest of the control points; bounds hold if it is positive
};
/// `recentre`: the origin is moved to the middle of the control points' box first, which tightens the bounds
/// of rational patches and does nothing to others.
DerivativeBounds derivativeBounds(const PatchSet& set, const Patch& patch, double eps, bool recentre = true);

/// Segments along u and v, >= 1, not yet rounded up: infinite if there is no bound (a weight is not
/// positive).
dvec2 segmentsOf(const DerivativeBounds& bounds, double eps, FactorRule rule);

/// Segments of a Bézier triangle's three sides, >= 1, not yet rounded up (section 7.4.3; SC-57). The bound
/// holds for the uniform tessellation with the largest of them. Polynomial triangles only.
std::array<double, 3> triangleSegments(const PatchSet& set, const Patch& patch, double eps);

/// Which constant bounds a PN triangle's deviation by the distances of its tangent points (section 7.4.4).
enum class PnBound {
  Boundary,  ///< 9/4: from the boundaries alone; an estimate
  Tied,      ///< 39/4: the inner control point as PN triangles have it, the worst signs
  Safe       ///< 45/4: any inner control point within 1.5 distances
};
double constantOf(PnBound bound);
/// Largest distance of the six tangent points of a cubic triangle from the line of their side's corners.
double largestTangentDistance(const PatchSet& set, const Patch& patch);
/// Segments of every side, >= 1, not yet rounded up.
double pnSegments(const PatchSet& set, const Patch& patch, double eps, PnBound bound);

/// Sizes of a curve from its control points, to be divided by the length that a segment may have
/// (section 7.4.1; SC-54). None of them bounds the deviation.
enum class CurveSize {
  Chord,     ///< distance of the ends (Chung and Kim 2003); a lower bound
  Rockwood,  ///< degree times the largest distance of successive control points: bounds |c'|
  Kumar      ///< length of the vector of the largest |c'_x|, |c'_y|, |c'_z|: bounds all secants
};
constexpr EnumNames<CurveSize, 3> enumNames(CurveSize) {
  return {{{{CurveSize::Chord, "chord"}, {CurveSize::Kumar, "kumar"}, {CurveSize::Rockwood, "rockwood"}}}};
}
double sizeOf(CurveSize size, std::span<const glm::dvec3> points);

/// Whole factor of a number of segments, at most `most`; `capped` becomes true if that is too few.
int wholeFactor(double segments, int most, bool* capped = nullptr);

/// Length in object space that projects to `px` pixels at distance `depth` along the view of a camera whose
/// picture is `heightPx` high; `tanOffAxis`: tangent of the largest angle to the view's direction, which
/// makes the tolerance hold for displacements in any direction, 0 for those parallel to the picture.
double objectTolerance(double px, double depth, double tanHalfFov, int heightPx, double tanOffAxis = 0.0);

}  // namespace limen::surfaces

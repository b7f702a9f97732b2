// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "experiments/base/enum_names.h"
#include "renderer/techniques/reflections/vertex_reflection/star_surface.h"

namespace limen::reflections {

/// Which vector is taken for the gradient of the path's length |PE| + |PV| over the surface.
enum class GradientForm {
  Corrected,       ///< the gradient
  DirectionsOnly,  ///< as printed in Roger 2008, equation 2.2, with both directions towards P
  Printed          ///< equation 2.2 to the letter: one direction towards P, one away from it
};
constexpr EnumNames<GradientForm, 3> enumNames(GradientForm) {
  return {{{{GradientForm::Corrected, "corrected"},
            {GradientForm::DirectionsOnly, "directions_only"},
            {GradientForm::Printed, "printed"}}}};
}

/// What of the projected triangle of samples ends the search by being small.
enum class StopMeasure {
  Area,        ///< its area (the thesis); small as well if the triangle is thin or seen edge-on
  LongestSide  ///< half the square of its longest side
};
constexpr EnumNames<StopMeasure, 2> enumNames(StopMeasure) {
  return {{{{StopMeasure::Area, "area"}, {StopMeasure::LongestSide, "longest_side"}}}};
}

/// Three first samples.
enum class FirstGuess {
  Projections,   ///< radial projections of vertex and eye, and the third corner of an equilateral triangle
  FacingEye,     ///< a triangle in the middle of the side that the eye sees, whatever the vertex
  PreviousFrame  ///< a small triangle around the point found before; FacingEye where there was none
};
constexpr EnumNames<FirstGuess, 3> enumNames(FirstGuess) {
  return {{{{FirstGuess::Projections, "projections"},
            {FirstGuess::FacingEye, "facing_eye"},
            {FirstGuess::PreviousFrame, "previous_frame"}}}};
}

/// What is done against sample triangles that wander until the cap.
enum class Safeguard {
  None,      ///< the best of the last three samples (the thesis)
  KeepBest,  ///< the best sample ever seen
  Restart    ///< once more from FirstGuess::FacingEye where the cap is reached or the point found faces away
};
constexpr EnumNames<Safeguard, 3> enumNames(Safeguard) {
  return {{{{Safeguard::None, "none"}, {Safeguard::KeepBest, "keep_best"}, {Safeguard::Restart, "restart"}}}};
}

struct SolverSettings {
  GradientForm gradient = GradientForm::Corrected;
  FirstGuess guess = FirstGuess::Projections;
  Safeguard safeguard = Safeguard::Restart;
  int cap = 20;  ///< samples after the first three
  StopMeasure stop = StopMeasure::Area;
  double areaPx2 = 1.0;             ///< of the projected triangle, at which to stop; 0: not by size
  double gradientTolerance = 0.0;   ///< length of the gradient at which to stop; 0: not by gradient
  double determinantShare = 1e-12;  ///< least determinant over a^2 b^2; below it a sample is exchanged
  double leastSide = 0.05;          ///< of a first triangle, in radii
  double falseRootLength = 1e-3;    ///< largest |e| of a root that is no reflection
};

enum class Outcome {
  Found,
  Unconverged,  ///< cap reached
  FalseRoot,    ///< the segment from eye to vertex passes the surface there
  FacingAway,   ///< eye or vertex is behind the surface's tangent plane
  NoSurface     ///< no finite sample, or the surface ends
};

struct Reflection {
  glm::dvec3 point{0.0};  ///< relative to the surface's centre
  Outcome outcome = Outcome::NoSurface;
  int iterations = 0;  ///< samples after the first three, of both runs where there were two
  int backTracks = 0;
  bool restarted = false;
  double gradientLength = 0.0;
};

/// Where the surface lies along `direction` and the gradient there.
struct PathSample {
  glm::dvec3 direction{0.0}, point{0.0}, gradient{0.0};
  double length = 0.0;  ///< of the gradient
  glm::dvec3 e{0.0};    ///< sum of the two unit vectors towards the point
  glm::dvec3 normal{0.0};
};

/// Gradient of |PE| + |PV| at the surface's point in `direction` (Roger 2008, equation 2.2). `eye` and
/// `vertex` relative to the centre.
PathSample pathSample(const StarSurface& surface, glm::dvec3 direction, glm::dvec3 eye, glm::dvec3 vertex,
                      GradientForm form);

/// Position in pixels of a point relative to the centre; none if it is behind the viewer. Empty function: no
/// screen (stopping by area is then impossible).
using ToScreen = std::function<std::optional<glm::dvec2>(glm::dvec3)>;

/// The reflection point of `vertex` on `surface` seen from `eye`, by a secant method with three samples
/// (Roger 2008, section 2.2). Bad input (positions at the centre, not finite) gives Outcome::NoSurface.
/// `previous`: the point found before, for FirstGuess::PreviousFrame. `inside`: the mirror is the inner side.
Reflection reflectVertex(const StarSurface& surface, glm::dvec3 eye, glm::dvec3 vertex,
                         const SolverSettings& settings, const ToScreen& toScreen = {},
                         std::optional<glm::dvec3> previous = {}, bool inside = false);

/// Angle between the normal and the half-vector towards eye and vertex, rad; independent of the solver's
/// gradient.
double halfVectorAngle(const StarSurface& surface, glm::dvec3 point, glm::dvec3 eye, glm::dvec3 vertex);

/// The reflection point by search alone, with no gradient: the shortest path over a dense grid of directions,
/// refined by ever finer grids around the best. For convex surfaces seen from outside, where the reflection
/// point is the minimum (a body between eye and vertex makes it the point where the segment enters).
glm::dvec3 shortestPathPoint(const StarSurface& surface, glm::dvec3 eye, glm::dvec3 vertex);

}  // namespace limen::reflections

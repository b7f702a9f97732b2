// SPDX-License-Identifier: BSD-3-Clause
// Whether a part of a patch is flat enough to be drawn as a polygon, from its control points on the screen
// (Schwarz 2009, section 7.2.1; SC-37).
#pragma once

#include <span>

#include "experiments/base/enum_names.h"
#include "renderer/surfaces/patch_set.h"

namespace limen::surfaces {

/// All are lengths in pixels, to be compared with a tolerance.
enum class Flatness {
  Control,        ///< of control points from the chord or polygon: bounds the deviation
  Corresponding,  ///< of control points from the places they would have if flat: bounds it at equal
                  ///< parameters as well
  Line,           ///< of control points from the infinite line or plane: misses loops
  Midpoint,       ///< of the middle from the chord's or polygon's middle: misses S-curves
  Length,  ///< control polygon's length less the chord's; of a patch the net's area less the polygon's, over
           ///< its longest side
  Differences,  ///< second differences, as in central differencing, scaled to the deviation they may cause
  ParameterMidpoint,  ///< of the middle from the middle of the chord, at equal parameters
  Extent              ///< size of the part: bounds nothing about its shape
};
constexpr EnumNames<Flatness, 8> enumNames(Flatness) {
  return {{{{Flatness::Control, "control_to_chord"},
            {Flatness::Corresponding, "control_to_corresponding"},
            {Flatness::Line, "control_to_line"},
            {Flatness::Midpoint, "midpoint_to_chord"},
            {Flatness::Length, "length"},
            {Flatness::Differences, "differences"},
            {Flatness::ParameterMidpoint, "midpoint_to_corresponding"},
            {Flatness::Extent, "extent"}}}};
}

/// Of a curve whose control points are homogeneous screen points (w x, w y, w), w > 0.
double curveFlatness(Flatness kind, std::span<const glm::dvec3> points);

/// Of a patch's interior and sides, control points in the order of patch_set.h.
double rectangleFlatness(Flatness kind, int degreeU, int degreeV, std::span<const glm::dvec3> points);
double triangleFlatness(Flatness kind, int degree, std::span<const glm::dvec3> points);

}  // namespace limen::surfaces

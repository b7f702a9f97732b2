// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "experiments/base/enum_names.h"

namespace limen::perception {

/// Retinal velocity that remains after the eye's tracking of a moving stimulus. Daly 1998; Schwarz 2009,
/// section 10.3.
enum class EyeMovement {
  Literal,   ///< |v - min(0.82 v + 0.15, 80)|: vanishes at 0.833 deg/s
  Floor,     ///< max(literal, least)
  Monotone,  ///< max(0.15, 0.18 v - 0.15) below saturation
  None       ///< retinal velocity = screen velocity
};

constexpr EnumNames<EyeMovement, 4> enumNames(EyeMovement) {
  return {{{{EyeMovement::Literal, "literal"},
            {EyeMovement::Floor, "floor"},
            {EyeMovement::Monotone, "monotone"},
            {EyeMovement::None, "none"}}}};
}

inline constexpr double kLeastRetinalVelocityDegS = 0.15;

/// Velocity on the retina [deg/s] of a stimulus that moves with `screenDegS` >= 0. NaN counts as 0.
double retinalVelocityDegS(double screenDegS, EyeMovement model = EyeMovement::Monotone,
                           double leastDegS = kLeastRetinalVelocityDegS);

/// Screen velocity [deg/s] of a displacement in pixels per frame.
inline double screenVelocityDegS(double displacementPx, double refreshHz, double pixelsPerDegree) {
  return refreshHz * displacementPx / pixelsPerDegree;
}

}  // namespace limen::perception

// SPDX-License-Identifier: BSD-3-Clause
#include "perception/vision/eye_movement.h"

#include <algorithm>
#include <cmath>

namespace limen::perception {
namespace {

// Daly 1998: smooth pursuit reaches 82 % of the target's speed on top of the drift, and 80 deg/s at most.
constexpr double kPursuitGain = 0.82, kDriftDegS = 0.15, kFastestPursuitDegS = 80.0;
constexpr double kLargestDegS = 1e9;  ///< what an infinite velocity counts as

}  // namespace

double retinalVelocityDegS(double screenDegS, EyeMovement model, double leastDegS) {
  const double screen = screenDegS > 0.0 ? std::min(screenDegS, kLargestDegS) : 0.0;
  const double least = leastDegS > 0.0 ? std::min(leastDegS, kLargestDegS) : 0.0;
  const double eye = std::min(kPursuitGain * screen + kDriftDegS, kFastestPursuitDegS);
  switch (model) {
    case EyeMovement::Literal:
      return std::abs(screen - eye);
    case EyeMovement::Floor:
      return std::max(std::abs(screen - eye), least);
    case EyeMovement::Monotone:
      // Without the absolute value: an eye that drifts past a slow target sees it move at least as fast as
      // the drift.
      return std::max(screen - eye, least);
    case EyeMovement::None:
      break;
  }
  return screen;
}

}  // namespace limen::perception

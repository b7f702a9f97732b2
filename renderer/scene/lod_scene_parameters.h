// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace limen::scene {

/// How the camera of an LOD scene moves: towards or past what it looks at, in a straight line at constant
/// speed without turning.
struct Ride {
  glm::dvec3 target{0.0};          ///< looked at when the ride begins
  glm::dvec3 back{0.0, 0.0, 1.0};  ///< unit, from the target to the eye
  /// Unit, the way of an approach; the zero vector: straight at the target.
  glm::dvec3 forward{0.0};
  double distance = 1.0;
  std::string motion;  ///< "approach", "horizontal" or "still"
  double speed = 0.0, durationS = 0.0;
  double nearest = 0.0;  ///< an approach ends at this distance at the latest
  double verticalFovDeg = 32.0;
};
void setRide(Scene& scene, const Ride& ride);

/// Parameters distance, motion, speed, duration_s with the given defaults.
std::vector<Parameter> rideParameters(double distance, double longest, double speed, double fastest);
/// Reads them.
Ride rideOf(const ParameterValues& values);

/// Parameters switch_distance, switch_growth: level i + 1 from switch_distance * switch_growth^i on.
std::vector<Parameter> switchParameters(double distance, double farthest);
std::vector<double> switchDistances(const ParameterValues& values, size_t levels);

}  // namespace limen::scene

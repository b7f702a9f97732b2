// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <variant>
#include <vector>

#include "experiments/base/settings_table.h"
#include "renderer/scene/scene.h"

namespace limen::scene {

/// The camera moves towards what it looks at.
struct Approach {
  static constexpr const char *kKind = "approach", *kSummary = "towards the object";
  double speed = 1.0;      ///< world units/s; 0: still
  double durationS = 4.5;  ///< ends earlier if it would reach the object
  static const SettingsTable<Approach>& table();
};

/// The camera moves past what it looks at.
struct Horizontal {
  static constexpr const char *kKind = "horizontal", *kSummary = "past the object";
  double speed = 1.0;  ///< world units/s; 0: still
  double durationS = 4.5;
  static const SettingsTable<Horizontal>& table();
};

struct Still {
  static constexpr const char *kKind = "still", *kSummary = "the camera rests";
};

/// How the camera of an LOD scene moves, in a straight line at constant speed without turning.
using CameraMotion = std::variant<Approach, Horizontal, Still>;

/// Where the motion begins.
struct Ride {
  glm::dvec3 target{0.0};          ///< looked at when the ride begins
  glm::dvec3 back{0.0, 0.0, 1.0};  ///< unit, from the target to the eye
  /// Unit, the direction of an approach; the zero vector: straight at the target.
  glm::dvec3 forward{0.0};
  double distance = 1.0;  ///< from the eye to the target
  double nearest = 0.0;   ///< an approach ends at this distance at the latest
  double verticalFovDeg = 32.0;
};
void setRide(Scene& scene, const Ride& ride, const CameraMotion& motion);

/// Distances at which levels change, set by hand: level i + 1 is shown from distance * growth^i on.
struct SwitchSettings {
  double distance = 1.0;  ///< world units
  double growth = 2.0;
  static const SettingsTable<SwitchSettings>& table();
  std::vector<double> distances(size_t levels) const;
};

/// Lines of an LOD scene's table for its members `distance`, `motion` and `switching`.
template <class S>
Binding<S> distanceBinding(double S::*member, double longest) {
  return {member, "distance", Range{0.02 * longest, longest}, "world units",
          "Distance from the eye to the object's centre when the ride begins"};
}
template <class S>
Binding<S> motionBinding(CameraMotion S::*member) {
  return {member, "motion", "How the camera moves", "Schwarz 2009, section 10.4.2"};
}
template <class S>
Binding<S> switchBinding(SwitchSettings S::*member) {
  return Binding<S>(member, "switching", "Distances at which levels change").shorthand("distance");
}

}  // namespace limen::scene

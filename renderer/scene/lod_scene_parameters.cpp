// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/lod_scene_parameters.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/stage.h"

namespace limen::scene {

namespace {

template <class Motion>
Binding<Motion> speedBinding(double Motion::*member) {
  return {member,
          "speed",
          Range{0.0, 50.0},
          "world units/s",
          "Speed of the camera; 0 is still",
          "Schwarz 2009, section 10.4 (values not given there)"};
}

}  // namespace

const SettingsTable<Approach>& Approach::table() {
  static const SettingsTable<Approach> kTable = {
      speedBinding(&Approach::speed).formerly({"speed"}),
      Binding(&Approach::durationS, "duration_s", Range{0.1, 60.0}, "s",
              "Length of the ride; it ends earlier if it would reach the object",
              "Schwarz 2009, section 10.4.1")
          .formerly({"duration_s"})};
  return kTable;
}

const SettingsTable<Horizontal>& Horizontal::table() {
  static const SettingsTable<Horizontal> kTable = {speedBinding(&Horizontal::speed),
                                                   {&Horizontal::durationS,
                                                    "duration_s",
                                                    {0.1, 60.0},
                                                    "s",
                                                    "Length of the ride",
                                                    "Schwarz 2009, section 10.4.1"}};
  return kTable;
}

const SettingsTable<SwitchSettings>& SwitchSettings::table() {
  using S = SwitchSettings;
  static const SettingsTable<S> kTable = {
      Binding(&S::distance, "distance", Range{1.0, 100.0}, "world units",
              "Distance from which the second level is shown",
              "Schwarz 2009, section 10.3.5 (values not given there)")
          .formerly({"switch_distance"}),
      Binding(&S::growth, "growth", Range{1.01, 10.0}, "",
              "Each further level is shown from this many times the distance of the one before")
          .formerly({"switch_growth"})};
  return kTable;
}

std::vector<double> SwitchSettings::distances(size_t levels) const {
  std::vector<double> out;
  for (size_t i = 0; i + 1 < levels; ++i) out.push_back(distance * std::pow(growth, static_cast<double>(i)));
  return out;
}

void setRide(Scene& scene, const Ride& ride, const CameraMotion& motion) {
  Camera from;
  from.target = ride.target;
  from.eye = ride.target + ride.distance * ride.back;
  from.verticalFovDeg = ride.verticalFovDeg;
  const auto* approach = std::get_if<Approach>(&motion);
  const auto* horizontal = std::get_if<Horizontal>(&motion);
  const double speed = approach ? approach->speed : horizontal ? horizontal->speed : 0.0;
  if (speed == 0.0) {
    setStillCamera(scene, from);
    return;
  }
  glm::dvec3 velocity = speed * (ride.forward == glm::dvec3(0.0) ? -ride.back : ride.forward);
  double duration = approach ? approach->durationS : horizontal->durationS;
  if (horizontal)
    velocity = speed * glm::normalize(glm::cross(from.up, ride.back));
  else
    duration = std::clamp((ride.distance - ride.nearest) / speed, 0.001, duration);
  Camera to = from;
  to.eye += duration * velocity;
  to.target += duration * velocity;
  scene.camera.keys = {{0.0, from}, {duration, to}};
  scene.camera.runIn = true;
}

}  // namespace limen::scene

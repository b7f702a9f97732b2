// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/scene/lod_scene_parameters.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/stage.h"

namespace limen::scene {

void setRide(Scene& scene, const Ride& ride) {
  Camera from;
  from.target = ride.target;
  from.eye = ride.target + ride.distance * ride.back;
  from.verticalFovDeg = ride.verticalFovDeg;
  if (ride.motion == "still" || ride.speed == 0.0) {
    setStillCamera(scene, from);
    return;
  }
  glm::dvec3 velocity = ride.speed * (ride.forward == glm::dvec3(0.0) ? -ride.back : ride.forward);
  double duration = ride.durationS;
  if (ride.motion == "horizontal")
    velocity = ride.speed * glm::normalize(glm::cross(from.up, ride.back));
  else
    duration = std::clamp((ride.distance - ride.nearest) / ride.speed, 0.001, duration);
  Camera to = from;
  to.eye += duration * velocity;
  to.target += duration * velocity;
  scene.camera.keys = {{0.0, from}, {duration, to}};
  scene.camera.runIn = true;
}

std::vector<Parameter> rideParameters(double distance, double longest, double speed, double fastest) {
  return {realParameter("distance", distance, 0.02 * longest, longest, "world units",
                        "From the eye to the object's middle when the ride begins"),
          choiceParameter("motion", "approach", {"approach", "horizontal", "still"},
                          "How the camera moves: towards the object, past it, or not at all",
                          "Schwarz 2009, section 10.4.2"),
          realParameter("speed", speed, 0.0, fastest, "world units/s", "Speed of the camera; 0 is still",
                        "Schwarz 2009, section 10.4 (values not given there)"),
          realParameter("duration_s", 4.5, 0.1, 60.0, "s",
                        "Length of the ride; an approach ends earlier where it would reach the object",
                        "Schwarz 2009, section 10.4.1")};
}

Ride rideOf(const ParameterValues& values) {
  Ride ride;
  ride.distance = values.real("distance");
  ride.motion = values.text("motion");
  ride.speed = values.real("speed");
  ride.durationS = values.real("duration_s");
  return ride;
}

std::vector<Parameter> switchParameters(double distance, double farthest) {
  return {realParameter("switch_distance", distance, 0.01 * farthest, farthest, "world units",
                        "Distance from which the second level is shown, set by hand",
                        "Schwarz 2009, section 10.3.5 (values not given there)"),
          realParameter("switch_growth", 2.0, 1.01, 10.0, "",
                        "Each further level is shown from this many times the distance of the one before")};
}

std::vector<double> switchDistances(const ParameterValues& values, size_t levels) {
  std::vector<double> out;
  for (size_t i = 0; i + 1 < levels; ++i)
    out.push_back(values.real("switch_distance") *
                  std::pow(values.real("switch_growth"), static_cast<double>(i)));
  return out;
}

}  // namespace limen::scene

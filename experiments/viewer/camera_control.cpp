// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/camera_control.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace limen::viewer {
namespace {

using scene::Camera;

/// Some vector perpendicular to `axis`; both are unit vectors.
glm::dvec3 anyAcross(glm::dvec3 axis) {
  const glm::dvec3 size = glm::abs(axis);
  const glm::dvec3 other = size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
                           : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                                : glm::dvec3(0.0, 0.0, 1.0);
  return glm::normalize(glm::cross(axis, other));
}

/// Component of `v` perpendicular to `axis`, normalised; any perpendicular vector if it vanishes.
glm::dvec3 across(glm::dvec3 v, glm::dvec3 axis) {
  // Two cross products instead of v minus its component along the axis, which cancels near the poles.
  const glm::dvec3 part = glm::cross(glm::cross(axis, v), axis);
  const double length = glm::length(part);
  return length > 0.0 && std::isfinite(length) ? part / length : anyAcross(axis);
}

struct Frame {
  glm::dvec3 forward, right, up;  ///< unit; `up` is the picture's
};

Frame frameOf(const Camera& camera) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 up = across(camera.up, forward);
  return {forward, glm::cross(forward, up), up};
}

/// `v` rotated about `axis` by `azimuthRad` (counter-clockwise seen from its tip) and away from it by
/// `polarRad`, preserving its length. A vector that is nearer to the axis than the limit may stay there but
/// comes no nearer.
glm::dvec3 turned(glm::dvec3 v, glm::dvec3 axis, double azimuthRad, double polarRad) {
  const double length = glm::length(v), limit = glm::radians(kPoleDeg), pi = std::acos(-1.0);
  // Well conditioned at all angles, unlike the arc cosine of the dot product.
  const double polar = std::atan2(glm::length(glm::cross(axis, v)), glm::dot(axis, v));
  // Any less and a camera could not tell up from the view direction (checkCamera()).
  constexpr double kLeast = 1e-5;
  const double low = std::clamp(polar, kLeast, limit), high = pi - std::clamp(pi - polar, kLeast, limit);
  const double turnedPolar = std::clamp(polar + polarRad, low, high);
  const glm::dvec3 outward = across(v, axis);
  const glm::dvec3 around = outward * std::cos(azimuthRad) + glm::cross(axis, outward) * std::sin(azimuthRad);
  return length * (axis * std::cos(turnedPolar) + around * std::sin(turnedPolar));
}

/// Eye and target moved by the same vector, the one by which the eye moves after rounding, so that the view
/// direction does not degrade far from the origin.
Camera moved(Camera camera, glm::dvec3 by) {
  const glm::dvec3 eye = camera.eye + by;
  camera.target += eye - camera.eye;
  camera.eye = eye;
  return camera;
}

double halfHeight(const Camera& camera) { return std::tan(0.5 * glm::radians(camera.verticalFovDeg)); }

}  // namespace

Camera orbit(const Camera& camera, glm::dvec2 drag, const ControlSpeeds& speeds) {
  if (drag == glm::dvec2(0.0)) return camera;
  Camera out = camera;
  out.eye = camera.target + turned(camera.eye - camera.target, glm::normalize(camera.up),
                                   -drag.x * speeds.orbitRad, -drag.y * speeds.orbitRad);
  return out;
}

Camera look(const Camera& camera, glm::dvec2 drag, const ControlSpeeds& speeds) {
  if (drag == glm::dvec2(0.0)) return camera;
  Camera out = camera;
  out.target = camera.eye + turned(camera.target - camera.eye, glm::normalize(camera.up),
                                   -drag.x * speeds.lookRad, drag.y * speeds.lookRad);
  return out;
}

Camera pan(const Camera& camera, glm::dvec2 drag) {
  if (drag == glm::dvec2(0.0)) return camera;
  const Frame frame = frameOf(camera);
  const double windowHeight = 2.0 * halfHeight(camera) * glm::length(camera.target - camera.eye);
  return moved(camera, windowHeight * (frame.up * drag.y - frame.right * drag.x));
}

Camera dolly(const Camera& camera, double steps, double diagonal, const ControlSpeeds& speeds) {
  if (steps == 0.0) return camera;
  const glm::dvec3 back = camera.eye - camera.target;
  const glm::dvec3 size = glm::max(glm::abs(camera.eye), glm::abs(camera.target));
  // Nearer than a million roundings of its coordinates, the rounding would show in the view direction.
  const double rounding = std::numeric_limits<double>::epsilon() * std::max({size.x, size.y, size.z});
  const double distance = glm::length(back);
  const double nearest = std::max(kNearestShare * diagonal, 1e6 * rounding);
  const double farthest = std::max(kFarthestShare * diagonal, nearest);
  // A camera that is already outside may stay where it is but goes no further.
  const double wanted = std::clamp(distance * std::pow(speeds.dollyFactor, -steps),
                                   std::min(nearest, distance), std::max(farthest, distance));
  Camera out = camera;
  out.eye = camera.target + back * (wanted / distance);
  return out;
}

Camera zoom(const Camera& camera, double steps, const ControlSpeeds& speeds) {
  if (steps == 0.0) return camera;
  Camera out = camera;
  const double half = std::atan(halfHeight(camera) * std::pow(speeds.zoomFactor, -steps));
  out.verticalFovDeg = std::clamp(2.0 * glm::degrees(half), std::min(kNarrowestFovDeg, camera.verticalFovDeg),
                                  std::max(kWidestFovDeg, camera.verticalFovDeg));
  return out;
}

Camera fly(const Camera& camera, const FlyKeys& keys, double seconds, double diagonal,
           const ControlSpeeds& speeds) {
  const Frame frame = frameOf(camera);
  glm::dvec3 direction =
      keys.forward * frame.forward + keys.right * frame.right + keys.up * glm::normalize(camera.up);
  const double size = glm::length(direction);
  if (!(size > 0.0) || !(seconds > 0.0)) return camera;
  if (size > 1.0) direction /= size;
  return moved(camera, direction * (speeds.flyShare * diagonal * seconds));
}

Camera frameAll(const Camera& camera, const scene::Bounds& bounds, double aspect) {
  if (bounds.empty()) return camera;
  Camera out = camera;
  out.target = bounds.centre();
  // The narrower of the two fields of view.
  const double half = std::atan(halfHeight(camera) * std::min(1.0, aspect));
  const double diagonal = bounds.diagonal();
  const double distance =
      diagonal > 0.0 ? 0.5 * diagonal / std::sin(half) : glm::length(camera.eye - camera.target);
  out.eye = out.target - distance * frameOf(camera).forward;
  return out;
}

}  // namespace limen::viewer

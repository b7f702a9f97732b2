// SPDX-License-Identifier: BSD-3-Clause
// Cameras for tests of their control, and what is asked of all that it gives.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "experiments/viewer/camera_control.h"
#include "renderer/scene/camera_text.h"

namespace limen::viewer::fixtures {

using scene::Camera;

inline constexpr double kRounding = std::numeric_limits<double>::epsilon();

inline double distanceOf(const Camera& camera) { return glm::length(camera.eye - camera.target); }

/// Angle between the view and the up axis, degrees.
inline double polarDeg(const Camera& camera) {
  const glm::dvec3 view = camera.target - camera.eye;
  return glm::degrees(std::atan2(glm::length(glm::cross(view, camera.up)), glm::dot(view, camera.up)));
}

/// Largest size of a coordinate.
inline double reach(const Camera& camera) {
  const glm::dvec3 size = glm::max(glm::abs(camera.eye), glm::abs(camera.target));
  return std::max({size.x, size.y, size.z});
}

/// A scene of diagonal 2 near the origin and the same moved by a million diagonals; a tilted up axis of
/// another length.
inline std::vector<Camera> cameras() {
  const glm::dvec3 far = glm::dvec3(2e6 / std::sqrt(3.0));
  return {Camera{{1.5, 1.0, 2.5}, {0.1, 0.2, -0.1}, {0.0, 1.0, 0.0}, 40.0},
          Camera{far + glm::dvec3(1.5, 1.0, 2.5), far + glm::dvec3(0.1, 0.2, -0.1), {0.0, 1.0, 0.0}, 40.0},
          Camera{{-1.0, 2.0, 0.5}, {0.0, 0.0, 0.0}, {0.3, -2.0, 3.0}, 70.0}};
}

inline void expectUsable(const Camera& camera, const Camera& start) {
  ASSERT_NO_THROW(checkCamera(camera, ""));
  ASSERT_EQ(camera.up, start.up);
}

}  // namespace limen::viewer::fixtures

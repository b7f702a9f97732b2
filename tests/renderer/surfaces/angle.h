// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <glm/glm.hpp>

namespace limen::surfaces {

inline double angleDeg(glm::dvec3 a, glm::dvec3 b) {
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

}  // namespace limen::surfaces

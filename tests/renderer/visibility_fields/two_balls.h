// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <glm/glm.hpp>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"

namespace limen::techniques {

inline constexpr double kBall = 0.3;
inline constexpr glm::dvec3 kFirstBall{-0.6, 1.0, 0.1}, kSecondBall{0.6, 1.2, -0.1};

inline scene::Mesh ballMeshes() {
  scene::Mesh balls = scene::sphere(kFirstBall, kBall, 24);
  scene::append(balls, scene::sphere(kSecondBall, kBall, 24));
  return balls;
}

/// Two balls that hang as one part above the ground, seen from below them straight down.
inline scene::Scene twoBallsOverGround() {
  scene::Scene scene;
  scene::addGround(scene, 8.0);
  scene::addPart(scene, "balls", ballMeshes(), glm::vec3(0.5F));
  scene.lights = {scene::lightTowards({0.0, 4.0, 0.0}, {0.0, 0.0, 0.0}, glm::dvec2(0.8))};
  scene::setStillCamera(scene, {{0.0, 0.4, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -1.0}, 60.0});
  return scene;
}

}  // namespace limen::techniques

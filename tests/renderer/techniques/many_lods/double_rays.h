// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "renderer/scene/scene.h"

namespace limen::techniques {

struct Met {
  double along = INFINITY;
  glm::dvec3 position{0.0}, normal{0.0};  // towards where the ray comes from
  glm::dvec3 albedo{0.0};
};

/// In double precision, one triangle after the other.
inline Met firstMet(const scene::Scene& scene, glm::dvec3 origin, glm::dvec3 direction, double least,
                    double most) {
  Met out;
  out.along = most;
  bool found = false;
  for (const scene::Part& part : scene.parts)
    for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i) {
      const glm::uvec3 t = scene.mesh.triangles[i];
      const glm::dvec3 a = scene.mesh.positions[t.x], e1 = scene.mesh.positions[t.y] - a,
                       e2 = scene.mesh.positions[t.z] - a;
      const glm::dvec3 p = glm::cross(direction, e2);
      const double determinant = glm::dot(e1, p);
      if (determinant == 0.0) continue;
      const glm::dvec3 s = origin - a, q = glm::cross(s, e1);
      const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
      const double along = glm::dot(e2, q) / determinant;
      if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && along > least && along < out.along)) continue;
      found = true;
      out.along = along;
      out.normal = glm::normalize(glm::cross(e1, e2));
      if (glm::dot(out.normal, direction) > 0.0) out.normal = -out.normal;
      out.albedo = glm::dvec3(scene.materials[part.material].albedo);
    }
  if (!found) out.along = INFINITY;
  if (found) out.position = origin + out.along * direction;
  return out;
}

/// From the eye through a pixel's middle, unit.
inline glm::dvec3 pixelDirection(const scene::Scene& scene, int x, int y, int width, int height) {
  const scene::Camera camera = scene.camera.at(0.0);
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const double tangent = std::tan(glm::radians(0.5 * camera.verticalFovDeg));
  return glm::normalize(forward + tangent * ((2.0 * (x + 0.5) / width - 1.0) * width / height * right -
                                             (2.0 * (y + 0.5) / height - 1.0) * up));
}

}  // namespace limen::techniques

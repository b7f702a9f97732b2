// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace limen::frame {

inline scene::Scene builtScene(const std::string& name,
                               const std::map<std::string, ParameterValue>& given = {}) {
  const scene::SceneInfo& info = scene::SceneRegistry::instance().get(name);
  return scene::buildScene(name, ParameterValues(info.allParameters(), given));
}

/// Nearest triangle along a ray, in double precision and without any acceleration: what rasterisation is
/// evaluated by.
struct Hit {
  uint32_t triangle = 0xffffffffU;
  double t = std::numeric_limits<double>::infinity();
};

class BruteForce {
 public:
  /// Vertices as the GPU has them: float, relative to `anchor`. The result is relative to it too.
  BruteForce(const scene::Scene& scene, glm::dvec3 anchor) : indices_(scene.mesh.triangles) {
    for (const glm::dvec3& position : scene.mesh.positions)
      vertices_.emplace_back(glm::vec3(position - anchor));
  }

  glm::dvec3 corner(uint32_t triangle, int which) const { return vertices_[indices_[triangle][which]]; }
  glm::dvec3 normal(uint32_t triangle) const {
    return glm::normalize(
        glm::cross(corner(triangle, 1) - corner(triangle, 0), corner(triangle, 2) - corner(triangle, 0)));
  }
  /// Distance along the ray to the triangle's plane.
  double planeDistance(uint32_t triangle, glm::dvec3 origin, glm::dvec3 direction) const {
    const glm::dvec3 n = normal(triangle);
    return glm::dot(n, corner(triangle, 0) - origin) / glm::dot(n, direction);
  }

  /// Nearest hit with t > tMin (Moeller and Trumbore, 1997).
  Hit trace(glm::dvec3 origin, glm::dvec3 direction, double tMin) const {
    Hit hit;
    for (uint32_t i = 0; i < indices_.size(); ++i) {
      const glm::dvec3 a = corner(i, 0), e1 = corner(i, 1) - a, e2 = corner(i, 2) - a;
      const glm::dvec3 h = glm::cross(direction, e2), s = origin - a;
      const double determinant = glm::dot(e1, h);
      if (determinant == 0.0) continue;
      const double u = glm::dot(s, h) / determinant;
      if (!(u >= 0.0 && u <= 1.0)) continue;
      const glm::dvec3 q = glm::cross(s, e1);
      const double v = glm::dot(direction, q) / determinant, t = glm::dot(e2, q) / determinant;
      if (v >= 0.0 && u + v <= 1.0 && t > tMin && t < hit.t) hit = {i, t};
    }
    return hit;
  }

 private:
  std::vector<glm::dvec3> vertices_;
  std::vector<glm::uvec3> indices_;
};

/// Rasterisers snap vertices to 1/256 of a pixel (GL asks for 4 bits at least, all devices give 8), so an
/// edge may pass a pixel's centre on the other side by that much. Offsets in pixels at which a ray must be
/// tried as well.
inline const std::vector<glm::dvec2>& snappingOffsets() {
  static const std::vector<glm::dvec2> kOffsets = [] {
    std::vector<glm::dvec2> out;
    for (int i = 0; i < 16; ++i) {
      const double angle = 2.0 * 3.14159265358979 * i / 16.0;
      out.emplace_back(std::cos(angle) / 128.0, std::sin(angle) / 128.0);
    }
    return out;
  }();
  return kOffsets;
}

}  // namespace limen::frame

// SPDX-License-Identifier: BSD-3-Clause
// Brute-force geometry for the tests of scenes.
#pragma once

#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "renderer/scene/scene.h"

namespace limen::scene::checks {

struct Hit {
  double distance = 0.0;  ///< in units of the direction's length
  size_t triangle = 0;
  glm::dvec3 normal{0.0};  ///< of the triangle, by its winding; not normalised
};

inline glm::dvec3 corner(const Mesh& mesh, size_t triangle, int k) {
  return mesh.positions[mesh.triangles[triangle][k]];
}

/// Nearest hit beyond `nearest` (Moeller and Trumbore 1997), of all triangles.
inline std::optional<Hit> intersect(const Mesh& mesh, glm::dvec3 origin, glm::dvec3 direction,
                                    double nearest = 0.0, double farthest = 1e300) {
  std::optional<Hit> best;
  for (size_t t = 0; t < mesh.triangles.size(); ++t) {
    const glm::dvec3 a = corner(mesh, t, 0), ab = corner(mesh, t, 1) - a, ac = corner(mesh, t, 2) - a;
    const glm::dvec3 p = glm::cross(direction, ac);
    const double determinant = glm::dot(ab, p);
    if (determinant == 0.0) continue;
    const glm::dvec3 from = origin - a, q = glm::cross(from, ab);
    const double u = glm::dot(from, p) / determinant, v = glm::dot(direction, q) / determinant;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0)) continue;
    const double distance = glm::dot(ac, q) / determinant;
    if (distance > nearest && distance < farthest) {
      farthest = distance;
      best = Hit{distance, t, glm::cross(ab, ac)};
    }
  }
  return best;
}

/// Direction of a camera ray; x and y from -1 to 1.
inline glm::dvec3 cameraRay(const Camera& camera, double x, double y, double aspect) {
  const glm::dvec3 forward = glm::normalize(camera.target - camera.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, camera.up)), up = glm::cross(right, forward);
  const double half = std::tan(0.5 * glm::radians(camera.verticalFovDeg));
  return glm::normalize(forward + x * half * aspect * right + y * half * up);
}

inline double signedVolume(const Mesh& mesh, size_t first, size_t count) {
  const glm::dvec3 origin = mesh.positions[0];
  double six = 0.0;
  for (size_t t = first; t < first + count; ++t)
    six += glm::dot(corner(mesh, t, 0) - origin,
                    glm::cross(corner(mesh, t, 1) - origin, corner(mesh, t, 2) - origin));
  return six / 6.0;
}

/// True if every directed edge is met by exactly one in the other direction: closed, manifold edges, one
/// winding.
inline bool closedManifold(const Mesh& mesh, size_t first, size_t count) {
  std::map<std::pair<uint32_t, uint32_t>, int> edges;
  for (size_t t = first; t < first + count; ++t)
    for (int k = 0; k < 3; ++k) ++edges[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}];
  for (const auto& [edge, uses] : edges) {
    const auto back = edges.find({edge.second, edge.first});
    if (uses != 1 || back == edges.end() || back->second != 1) return false;
  }
  return true;
}

inline double surfaceArea(const Mesh& mesh) {
  double area = 0.0;
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    area += 0.5 * glm::length(glm::cross(corner(mesh, t, 1) - corner(mesh, t, 0),
                                         corner(mesh, t, 2) - corner(mesh, t, 0)));
  return area;
}

}  // namespace limen::scene::checks

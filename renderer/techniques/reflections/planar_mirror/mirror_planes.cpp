// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/planar_mirror/mirror_planes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

namespace limen::techniques {

MirrorPlanes findMirrorPlanes(const scene::Scene& scene, glm::dvec3 anchor, int most,
                              const frame::ShownMirrors& shown) {
  struct Found {
    glm::dvec4 plane;
    double area = 0.0;
  };
  std::vector<Found> found;
  // Planes by their rounded normal: those of a curved mirror are many.
  std::map<std::tuple<int64_t, int64_t, int64_t>, std::vector<uint32_t>> byNormal;
  constexpr double kSameNormal = 1e-4;
  const double tolerance = 0x1p-20 * scene.bounds().diagonal();
  MirrorPlanes out;
  out.planeOf.assign(scene.mesh.triangles.size(), MirrorPlanes::kNone);
  for (size_t p = 0; p < scene.parts.size(); ++p) {
    const scene::Part& part = scene.parts[p];
    if (!shown.has(p) || !scene.materials[part.material].reflects()) continue;
    for (uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangleCount; ++t) {
      const glm::uvec3 corners = scene.mesh.triangles[t];
      const glm::dvec3 a = scene.mesh.positions[corners.x] - anchor,
                       b = scene.mesh.positions[corners.y] - anchor,
                       c = scene.mesh.positions[corners.z] - anchor;
      const glm::dvec3 cross = glm::cross(b - a, c - a);
      const double length = glm::length(cross);
      if (!(length > 0.0) || !std::isfinite(length)) continue;
      const glm::dvec3 normal = cross / length;
      const auto fits = [&](const glm::dvec4& plane) {
        const auto off = [&](glm::dvec3 point) {
          return std::abs(glm::dot(glm::dvec3(plane), point) + plane.w);
        };
        return glm::length(glm::dvec3(plane) - normal) < kSameNormal &&
               std::max({off(a), off(b), off(c)}) <= tolerance;
      };
      const auto cell = [](double v) {
        return static_cast<int64_t>(std::floor(v / (4.0 * kSameNormal) + 0.25));
      };
      auto& candidates = byNormal[{cell(normal.x), cell(normal.y), cell(normal.z)}];
      const auto known = std::find_if(candidates.begin(), candidates.end(),
                                      [&](uint32_t i) { return fits(found[i].plane); });
      const uint32_t index = known != candidates.end() ? *known : static_cast<uint32_t>(found.size());
      if (known == candidates.end()) {
        candidates.push_back(index);
        found.push_back({glm::dvec4(normal, -glm::dot(normal, a))});
      }
      found[index].area += 0.5 * length;
      out.planeOf[t] = index;
    }
  }
  std::vector<uint32_t> order(found.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](uint32_t a, uint32_t b) { return found[a].area > found[b].area; });
  std::vector<uint32_t> rank(found.size(), MirrorPlanes::kNone);
  for (size_t i = 0; i < order.size() && i < static_cast<size_t>(most); ++i) {
    rank[order[i]] = static_cast<uint32_t>(i);
    out.planes.push_back(found[order[i]].plane);
  }
  for (uint32_t& plane : out.planeOf)
    if (plane != MirrorPlanes::kNone) plane = rank[plane];
  return out;
}

glm::dmat4 mirrorMatrix(glm::dvec4 plane) {
  glm::dmat4 matrix(1.0);
  for (int column = 0; column < 4; ++column)
    for (int row = 0; row < 3; ++row) matrix[column][row] -= 2.0 * plane[row] * plane[column];
  return matrix;
}

}  // namespace limen::techniques

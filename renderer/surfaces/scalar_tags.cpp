// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/scalar_tags.h"

#include <algorithm>

namespace limen::surfaces {

void tagCornerNormals(BaseMesh& mesh, double creaseDeg, const ScalarTags& tags) {
  BaseMesh smooth = mesh;
  computeCornerNormals(smooth, 180.0);
  computeCornerNormals(mesh, creaseDeg);
  // The sides of each vertex, in the order of triangles.
  std::vector<std::vector<glm::dvec3>> sides(mesh.positions.size());
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      std::vector<glm::dvec3>& own = sides[mesh.triangles[t][c]];
      const glm::dvec3& normal = mesh.cornerNormals[t][static_cast<size_t>(c)];
      if (std::find(own.begin(), own.end(), normal) == own.end()) own.push_back(normal);
    }
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const std::vector<glm::dvec3>& own = sides[mesh.triangles[t][c]];
      glm::dvec3& normal = mesh.cornerNormals[t][static_cast<size_t>(c)];
      const glm::dvec3& mean = smooth.cornerNormals[t][static_cast<size_t>(c)];
      if (own.size() < 2) {
        normal = mean;
        continue;
      }
      glm::dvec3 turn = normal - mean;
      if (own.size() == 2) turn += 0.5 * tags.bias * (own[0] - own[1]);
      const glm::dvec3 turned = mean + tags.sharpness * turn;
      const double length = glm::length(turned);
      if (length > 1e-9) normal = turned / length;
    }
}

}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/corner_normals.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "renderer/surfaces/mesh_edges.h"

namespace limen::surfaces {
namespace {

/// Disjoint sets of corners; corner c of triangle t is 3 t + c.
class CornerSets {
 public:
  explicit CornerSets(size_t corners) : parent_(corners) { std::iota(parent_.begin(), parent_.end(), 0U); }
  uint32_t root(uint32_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }
  void join(uint32_t a, uint32_t b) { parent_[root(a)] = root(b); }

 private:
  std::vector<uint32_t> parent_;
};

glm::dvec3 areaVector(const BaseMesh& mesh, glm::uvec3 t) {
  const glm::dvec3& a = mesh.positions[t.x];
  return glm::cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
}

double angleAt(const BaseMesh& mesh, glm::uvec3 t, int corner) {
  const glm::dvec3 &p = mesh.positions[t[corner]], a = mesh.positions[t[(corner + 1) % 3]] - p,
                   b = mesh.positions[t[(corner + 2) % 3]] - p;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

}  // namespace

size_t mergePositions(BaseMesh& mesh) {
  struct Before {
    bool operator()(const glm::dvec3& a, const glm::dvec3& b) const {
      return std::lexicographical_compare(&a.x, &a.x + 3, &b.x, &b.x + 3);
    }
  };
  std::map<glm::dvec3, uint32_t, Before> places;
  std::vector<glm::dvec3> merged;
  std::vector<uint32_t> to;
  for (const glm::dvec3& position : mesh.positions) {
    const auto [at, isNew] = places.try_emplace(position + 0.0, static_cast<uint32_t>(merged.size()));
    if (isNew) merged.push_back(position + 0.0);
    to.push_back(at->second);
  }
  mesh.positions = std::move(merged);
  std::vector<glm::uvec3> triangles;
  std::vector<std::array<glm::dvec3, 3>> normals;
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3 old = mesh.triangles[i], t(to[old.x], to[old.y], to[old.z]);
    if (t.x == t.y || t.y == t.z || t.z == t.x) continue;
    triangles.push_back(t);
    if (!mesh.cornerNormals.empty()) normals.push_back(mesh.cornerNormals[i]);
  }
  const size_t dropped = mesh.triangles.size() - triangles.size();
  mesh.triangles = std::move(triangles), mesh.cornerNormals = std::move(normals);
  return dropped;
}

void computeCornerNormals(BaseMesh& mesh, double creaseDeg) {
  const size_t count = mesh.triangles.size();
  std::vector<glm::dvec3> faces(count);
  for (size_t t = 0; t < count; ++t) {
    const glm::dvec3 area = areaVector(mesh, mesh.triangles[t]);
    faces[t] = glm::length(area) > 0.0 ? glm::normalize(area) : glm::dvec3(0.0);
  }
  CornerSets sets(3 * count);
  const double leastCosine = creaseDeg >= 180.0 ? -2.0 : std::cos(glm::radians(creaseDeg));
  for (const MeshEdge& edge : edgesOf(mesh.triangles)) {
    if (edge.sides != 2 || glm::dot(faces[edge.triangles[0]], faces[edge.triangles[1]]) <= leastCosine)
      continue;
    for (const uint32_t vertex : edge.vertices)
      sets.join(cornerOf(mesh.triangles, edge.triangles[0], vertex),
                cornerOf(mesh.triangles, edge.triangles[1], vertex));
  }
  std::vector<glm::dvec3> sums(3 * count, glm::dvec3(0.0)),
      ofVertex(mesh.positions.size(), glm::dvec3(0, 0, 1));
  for (uint32_t t = 0; t < count; ++t)
    for (uint32_t c = 0; c < 3; ++c)
      sums[sets.root(3 * t + c)] += angleAt(mesh, mesh.triangles[t], static_cast<int>(c)) * faces[t];
  mesh.cornerNormals.assign(count, {});
  for (int pass = 0; pass < 2; ++pass)
    for (uint32_t t = 0; t < count; ++t)
      for (uint32_t c = 0; c < 3; ++c) {
        const glm::dvec3 sum = sums[sets.root(3 * t + c)];
        glm::dvec3& vertexNormal = ofVertex[mesh.triangles[t][static_cast<int>(c)]];
        const double length = glm::length(sum);
        if (length > 1e-12) vertexNormal = sum / length;
        mesh.cornerNormals[t][c] = length > 1e-12 ? sum / length : vertexNormal;
      }
}

}  // namespace limen::surfaces

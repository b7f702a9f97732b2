// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/mesh_edges.h"

#include <algorithm>

namespace limen::surfaces {

std::vector<MeshEdge> edgesOf(const std::vector<glm::uvec3>& triangles) {
  struct Side {
    std::array<uint32_t, 2> vertices;
    uint32_t triangle;
    auto operator<=>(const Side&) const = default;
  };
  std::vector<Side> sides;
  for (uint32_t t = 0; t < triangles.size(); ++t)
    for (int c = 0; c < 3; ++c) {
      const uint32_t a = triangles[t][c], b = triangles[t][(c + 1) % 3];
      sides.push_back({{std::min(a, b), std::max(a, b)}, t});
    }
  std::sort(sides.begin(), sides.end());
  std::vector<MeshEdge> edges;
  for (const Side& side : sides) {
    if (edges.empty() || edges.back().vertices != side.vertices) edges.push_back({side.vertices, {}, 0});
    MeshEdge& edge = edges.back();
    if (edge.sides < 2) edge.triangles[edge.sides] = side.triangle;
    ++edge.sides;
  }
  return edges;
}

uint32_t cornerOf(const std::vector<glm::uvec3>& triangles, uint32_t triangle, uint32_t vertex) {
  const glm::uvec3& t = triangles[triangle];
  return 3 * triangle + (t.x == vertex ? 0U : t.y == vertex ? 1U : 2U);
}

}  // namespace limen::surfaces

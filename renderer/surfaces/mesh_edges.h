// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace limen::surfaces {

/// An undirected edge of a triangle mesh and the triangles along it.
struct MeshEdge {
  std::array<uint32_t, 2> vertices{};   ///< ascending
  std::array<uint32_t, 2> triangles{};  ///< the first two
  uint32_t sides = 0;                   ///< how many triangles: 1 at a boundary
};

/// Edges in ascending order of their vertices.
std::vector<MeshEdge> edgesOf(const std::vector<glm::uvec3>& triangles);

/// 3 t + c for the corner c of triangle t that is the vertex; the vertex must be one of its corners.
uint32_t cornerOf(const std::vector<glm::uvec3>& triangles, uint32_t triangle, uint32_t vertex);

}  // namespace limen::surfaces

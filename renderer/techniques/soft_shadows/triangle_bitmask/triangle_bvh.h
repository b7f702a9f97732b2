// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace limen::techniques {

using Corners3 = std::array<glm::vec3, 3>;

/// Bounding-volume hierarchy over triangles, as shaders walk it without a stack: nodes are stored depth
/// first, so that the next node is the first child, and `skip` leads past the whole subtree. Layouts are
/// those of std430 (triangle_bvh.glsl).
struct TriangleBvh {
  struct Node {
    glm::vec3 low;
    uint32_t skip;  ///< next node if this box is missed
    glm::vec3 high;
    uint32_t leaf;  ///< first triangle * 8 + number of triangles (1 to kLeaf); 0: inner node
  };
  struct Triangle {
    glm::vec3 a;
    uint32_t id;  ///< as given to build
    glm::vec3 b;
    uint32_t padding0 = 0;
    glm::vec3 c;
    uint32_t padding1 = 0;
  };
  static constexpr uint32_t kLeaf = 4;  ///< most triangles of a leaf

  std::vector<Node> nodes;          ///< at least one
  std::vector<Triangle> triangles;  ///< in the order of the leaves
};
static_assert(sizeof(TriangleBvh::Node) == 32 && sizeof(TriangleBvh::Triangle) == 48);

/// Splits by the surface-area heuristic over bins of the boxes' centres. Triangles with a corner that is not
/// finite are left out.
TriangleBvh buildTriangleBvh(const std::vector<Corners3>& triangles);

}  // namespace limen::techniques

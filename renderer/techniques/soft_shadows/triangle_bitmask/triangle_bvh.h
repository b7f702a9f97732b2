// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/techniques/soft_shadows/triangle_bitmask/triangle_bitmask_bindings.h"

namespace limen::techniques {

using Corners3 = std::array<glm::vec3, 3>;

/// Bounding-volume hierarchy over triangles, as shaders walk it without a stack: nodes stand depth first, so
/// that the next node is the first child, and `skip` leads past all that hangs below.
struct TriangleBvh {
  using Node = BvhNode;
  using Triangle = BvhTriangle;
  static constexpr uint32_t kLeaf = 4;  ///< most triangles of a leaf

  std::vector<Node> nodes;          ///< at least one
  std::vector<Triangle> triangles;  ///< in the order of the leaves
};

/// Splits by the surface-area heuristic over bins of the boxes' centres. Triangles with a corner that is not
/// finite are left out.
TriangleBvh buildTriangleBvh(const std::vector<Corners3>& triangles);

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <memory>
#include <vector>

namespace limen::ray_tracing {

struct TreeBox {
  glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};
  void extend(glm::vec3 point) { low = glm::min(low, point), high = glm::max(high, point); }
  void extend(const TreeBox& box) { low = glm::min(low, box.low), high = glm::max(high, box.high); }
  double halfArea() const;  ///< 0 if empty
};

/// A triangle as the build moves it about.
struct TreePrimitive {
  TreeBox box;
  uint32_t triangle = 0;
  /// Half of each coordinate, so that no sum overflows.
  glm::vec3 centre() const { return 0.5F * box.low + 0.5F * box.high; }
};

struct TreeNode;

/// A run of primitives that becomes a leaf or a node.
struct TreeChild {
  uint32_t first = 0, count = 0;
  TreeBox box, centres;            ///< of the primitives and of their centres
  std::unique_ptr<TreeNode> node;  ///< null: a leaf
};

struct TreeNode {
  std::array<TreeChild, 8> children;
  int count = 0;
  /// Child of each octant of the node: 4 for the upper half in x, 2 in y, 1 in z; -1: none.
  std::array<int, 8> childOf;
};

/// Tree over `primitives`, which it orders by leaves: at most three to a leaf, at most `levels` levels. There
/// must be at least one primitive.
TreeChild buildTree(std::vector<TreePrimitive>& primitives, int levels);

}  // namespace limen::ray_tracing

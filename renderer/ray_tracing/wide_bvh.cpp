// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/ray_tracing/wide_bvh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>

#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "renderer/ray_tracing/tree_build.h"

namespace limen::ray_tracing {
namespace {

bool isFinite(glm::vec3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Of the pitch, biased: below it 256 pitches would leave the normal floats of some direction.
constexpr int kLeastExponent = 27;

/// The grid of one axis: the finest pitch, a power of two, with which 255 steps reach across.
void setGrid(WideNode& node, int axis, const TreeBox& box) {
  node.origin[axis] = box.low[axis];
  const double extent = double(box.high[axis]) - double(box.low[axis]);
  int exponent = kLeastExponent;
  if (extent > 0.0) exponent = std::max(exponent, std::ilogb(extent / 255.0) + 127);
  do node.exponent[size_t(axis)] = static_cast<uint8_t>(exponent++);
  while (node.origin[axis] + 255.0 * node.pitch(axis) < box.high[axis]);
}

void setBox(WideNode& node, int axis, uint32_t child, const TreeBox& box) {
  const double pitch = node.pitch(axis), origin = node.origin[axis];
  uint8_t& low = node.low[size_t(axis)][child];
  uint8_t& high = node.high[size_t(axis)][child];
  low = static_cast<uint8_t>(std::clamp(std::floor((box.low[axis] - origin) / pitch), 0.0, 255.0));
  high = static_cast<uint8_t>(std::clamp(std::ceil((box.high[axis] - origin) / pitch), 0.0, 255.0));
  // The differences above may have been rounded.
  while (low > 0 && node.lowOf(axis, child) > box.low[axis]) --low;
  while (high < 255 && node.highOf(axis, child) < box.high[axis]) ++high;
}

/// Makes nodes and triangles of the tree, each node's children beside each other, depth first.
class Flattening {
 public:
  Flattening(const std::vector<TreePrimitive>& primitives, const std::vector<glm::vec3>& vertices,
             const std::vector<glm::uvec3>& triangles, std::vector<WideNode>& nodes,
             std::vector<LeafTriangle>& leaves)
      : primitives_(primitives), vertices_(vertices), triangles_(triangles), nodes_(nodes), leaves_(leaves) {}

  /// Returns the number of levels.
  int write(const TreeChild& of, size_t at) {
    const TreeNode& tree = *of.node;
    WideNode node{};
    for (int axis = 0; axis < 3; ++axis) setGrid(node, axis, of.box);
    node.firstNode = static_cast<uint32_t>(nodes_.size());
    node.firstTriangle = static_cast<uint32_t>(leaves_.size());
    const std::array<int, 8>& childOf = tree.childOf;
    for (uint32_t slot = 0; slot < 8; ++slot) {
      if (childOf[slot] < 0) continue;
      const TreeChild& child = tree.children[size_t(childOf[slot])];
      for (int axis = 0; axis < 3; ++axis) setBox(node, axis, slot, child.box);
      if (child.node) {
        node.inner = static_cast<uint8_t>(node.inner | 1U << slot);
        node.meta[slot] = static_cast<uint8_t>(0x38U + slot);
      } else {
        const auto offset = static_cast<uint32_t>(leaves_.size()) - node.firstTriangle;
        node.meta[slot] = static_cast<uint8_t>(((1U << child.count) - 1U) << 5U | offset);
        writeLeaf(child);
      }
    }
    nodes_.resize(nodes_.size() + size_t(std::popcount(node.inner)));
    nodes_[at] = node;
    int levels = 0;
    size_t next = node.firstNode;
    for (size_t slot = 0; slot < 8; ++slot)
      if (node.inner & 1U << slot)
        levels = std::max(levels, write(tree.children[size_t(childOf[slot])], next++));
    return levels + 1;
  }

 private:
  void writeLeaf(const TreeChild& leaf) {
    for (uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      const uint32_t triangle = primitives_[i].triangle;
      const glm::uvec3 t = triangles_[triangle];
      leaves_.push_back({vertices_[t.x], triangle, vertices_[t.y], 0, vertices_[t.z], 0});
    }
  }

  const std::vector<TreePrimitive>& primitives_;
  const std::vector<glm::vec3>& vertices_;
  const std::vector<glm::uvec3>& triangles_;
  std::vector<WideNode>& nodes_;
  std::vector<LeafTriangle>& leaves_;
};

std::vector<TreePrimitive> primitivesOf(const std::vector<glm::vec3>& vertices,
                                        const std::vector<glm::uvec3>& triangles) {
  std::vector<TreePrimitive> out;
  out.reserve(triangles.size());
  for (size_t i = 0; i < triangles.size(); ++i) {
    const glm::vec3 a = vertices[triangles[i].x], b = vertices[triangles[i].y], c = vertices[triangles[i].z];
    if (!isFinite(a) || !isFinite(b) || !isFinite(c)) continue;
    const glm::dvec3 n = glm::cross(glm::dvec3(b) - glm::dvec3(a), glm::dvec3(c) - glm::dvec3(a));
    if (n == glm::dvec3(0.0)) continue;
    TreePrimitive primitive;
    // Which zero is the least depends on the order: -0 becomes 0.
    for (const glm::vec3 corner : {a, b, c}) primitive.box.extend(corner + 0.0F);
    primitive.triangle = static_cast<uint32_t>(i);
    out.push_back(primitive);
  }
  return out;
}

}  // namespace

double WideNode::pitch(int axis) const {
  return std::bit_cast<float>(uint32_t{exponent[size_t(axis)]} << 23U);
}

WideBvh::WideBvh(const std::vector<glm::vec3>& vertices, const std::vector<glm::uvec3>& triangles) {
  std::vector<TreePrimitive> primitives = primitivesOf(vertices, triangles);
  if (primitives.empty()) return;
  const TreeChild root = buildTree(primitives, kRayLevels);
  triangles_.reserve(primitives.size());
  nodes_.resize(1);
  levels_ = Flattening(primitives, vertices, triangles, nodes_, triangles_).write(root, 0);
  if (levels_ > kRayLevels) throw std::logic_error("the tree for rays has more levels than their stack");
}

}  // namespace limen::ray_tracing

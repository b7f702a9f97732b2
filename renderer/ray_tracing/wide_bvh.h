// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace limen::ray_tracing {

/// Eight children in 80 bytes, their boxes on a grid of 8 bits an axis (Ylitie, Karras and Laine 2017).
/// Children are numbered by the octant of the node in which they lie: 4 for the upper half in x, 2 in y, 1 in
/// z.
struct WideNode {
  static constexpr uint32_t kChildren = 8, kMostLeafTriangles = 3;

  glm::vec3 origin;                 ///< grid position (0, 0, 0)
  std::array<uint8_t, 3> exponent;  ///< of the grid's pitch on each axis, biased by 127
  uint8_t inner;                    ///< bit i: child i is a node
  uint32_t firstNode;               ///< child nodes lie from here on, in order
  uint32_t firstTriangle;           ///< of the leaves
  /// 0: no child. Node: 0x38 + i. Leaf: as many ones as triangles in the upper three bits, place of the first
  /// from firstTriangle on in the others.
  std::array<uint8_t, kChildren> meta;
  std::array<std::array<uint8_t, kChildren>, 3> low, high;  ///< [axis][child]

  double pitch(int axis) const;
  double lowOf(int axis, uint32_t child) const {
    return origin[axis] + low[size_t(axis)][child] * pitch(axis);
  }
  double highOf(int axis, uint32_t child) const {
    return origin[axis] + high[size_t(axis)][child] * pitch(axis);
  }
};
static_assert(sizeof(WideNode) == 80);

/// A triangle in the order of the leaves.
struct LeafTriangle {
  glm::vec3 a;
  uint32_t triangle;  ///< number in the scene
  glm::vec3 b;
  uint32_t unused0;
  glm::vec3 c;
  uint32_t unused1;
};
static_assert(sizeof(LeafTriangle) == 48);

/// Tree over triangles for tracing rays: at most kRayLevels levels, built top down by the surface-area
/// heuristic over bins (Wald 2007) on all cores. The result depends on the triangles alone. Triangles without
/// area and those with a coordinate that is not finite are left out.
class WideBvh {
 public:
  /// Vertices that a triangle names must exist.
  WideBvh(const std::vector<glm::vec3>& vertices, const std::vector<glm::uvec3>& triangles);

  const std::vector<WideNode>& nodes() const { return nodes_; }  ///< root first; empty without triangles
  const std::vector<LeafTriangle>& triangles() const { return triangles_; }
  int levels() const { return levels_; }

 private:
  std::vector<WideNode> nodes_;
  std::vector<LeafTriangle> triangles_;
  int levels_ = 0;
};

}  // namespace limen::ray_tracing

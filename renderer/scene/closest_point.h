// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/scene.h"

namespace limen::scene {

/// Nearest point of a triangle mesh, in double precision, with a bounding-box tree. Degenerate triangles
/// count as the segment or point to which they collapse.
class ClosestPoint {
 public:
  /// Copies the corners. The mesh must have a triangle.
  explicit ClosestPoint(const Mesh& mesh);
  glm::dvec3 operator()(glm::dvec3 point) const;
  double distance(glm::dvec3 point) const { return glm::length((*this)(point)-point); }

 private:
  struct Node {
    Bounds bounds;
    uint32_t first = 0, count = 0;  // triangles of a leaf; count 0: an inner node
    uint32_t right = 0;             // the left child follows its parent
  };
  struct Triangle {
    glm::dvec3 a, b, c;
  };
  void build(uint32_t first, uint32_t count);

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

/// Nearest point of one triangle.
glm::dvec3 closestOnTriangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c, glm::dvec3 point);

/// Points spread evenly over the area of a mesh, seeded; none if it has no area.
std::vector<glm::dvec3> pointsOnSurface(const Mesh& mesh, int count, int64_t seed);

/// Two-sided Hausdorff distance between two surfaces, sampled: the largest distance from a vertex or from one
/// of `samples` points spread over the area (seeded) of either mesh to the other. Never above the true value.
double sampledDeviation(const Mesh& one, const Mesh& other, int samples = 8000, int64_t seed = 1);

}  // namespace limen::scene

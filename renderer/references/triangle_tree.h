// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/references/triangles.h"

namespace limen::references {

/// A ray in double precision, relative to the anchor.
struct ExactRay {
  static constexpr uint32_t kNoTriangle = 0xffffffffU;
  glm::dvec3 origin{0.0}, direction{0.0};  ///< any length
  uint32_t from = kNoTriangle;             ///< the triangle that it leaves
  double far = 1e300;                      ///< hits at 0 < t < far count, in units of the direction
};

struct ExactHit {
  uint32_t triangle = ExactRay::kNoTriangle;  ///< kNoTriangle: none
  double t = 0.0;
  glm::dvec3 weights{0.0};  ///< barycentric coordinates
};

/// Nearest hits of rays with triangles, all in double precision: a tree of boxes whose leaves hold few
/// triangles, halved at the median. Triangles without area or with a coordinate that is not a number are
/// never hit. A ray that leaves a surface meets neither the triangle that it leaves nor any whose plane
/// contains its origin up to Triangles::planeTolerance(): seen from there they are edge-on. Of hits at the
/// same distance that of the lowest triangle counts.
class TriangleTree {
 public:
  /// `triangles` must outlive it.
  explicit TriangleTree(const Triangles& triangles);
  ExactHit nearest(const ExactRay& ray) const;
  bool any(const ExactRay& ray) const;

 private:
  struct Box {
    glm::dvec3 low{1e300}, high{-1e300};
  };
  struct Node {
    Box box;
    uint32_t first = 0, count = 0;  ///< of triangles in order_; count 0: children are `first` and `first` + 1
  };
  void split(size_t node, std::vector<Box>& boxes);
  bool trace(const ExactRay& ray, bool anyIsEnough, ExactHit& hit) const;
  void test(const ExactRay& ray, uint32_t triangle, ExactHit& hit) const;

  const Triangles& triangles_;
  std::vector<uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace limen::references

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/references/convex_pieces.h"

namespace limen::references {

/// The union of rectangles with sides parallel to the axes, in double precision and without sampling: a line
/// sweeps along x over a segment tree that counts how often each interval of y is covered (Bentley 1977,
/// "Solutions to Klee's rectangle problems"). n rectangles cost O(n log n).
class RectangleUnion {
 public:
  struct Rectangle {
    glm::dvec2 low, high;
  };
  void clear() { rectangles_.clear(); }
  bool empty() const { return rectangles_.empty(); }
  const std::vector<Rectangle>& rectangles() const { return rectangles_; }
  /// A rectangle without area, or with a coordinate that is not a number, is ignored.
  void add(glm::dvec2 low, glm::dvec2 high);

  /// Area of the union.
  double area() { return areaWithin(nullptr); }
  /// Area of its part in a half-plane.
  double area(const HalfPlane& within) { return areaWithin(&within); }

 private:
  struct Side {
    double x;
    uint32_t first, last;  ///< intervals of y, the last one excluded
    int32_t change;
  };
  struct Node {
    int32_t covered = 0;  ///< rectangles that cover all of it but not all of its parent
    double length = 0.0;  ///< covered by any rectangle, within it
  };

  double areaWithin(const HalfPlane* within);
  void update(size_t node, uint32_t first, uint32_t last, const Side& side);
  double coveredWithin(size_t node, uint32_t first, uint32_t last, glm::dvec2 strip,
                       const HalfPlane& within) const;

  std::vector<Rectangle> rectangles_;
  std::vector<double> ys_;
  std::vector<Side> sides_;
  std::vector<Node> nodes_;
};

}  // namespace limen::references

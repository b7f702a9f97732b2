// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

namespace limen::references {

/// Twice the signed area of the triangle (origin, a, b).
inline double cross2(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// Points with n.x x + n.y y + offset >= 0. Normalised by HalfPlane::unit().
struct HalfPlane {
  glm::dvec2 n{0.0};
  double offset = 0.0;
  double at(glm::dvec2 p) const { return n.x * p.x + n.y * p.y + offset; }
};

/// Small convex polygon, counter-clockwise, in place.
class ConvexPolygon {
 public:
  static constexpr int kCapacity = 20;
  ConvexPolygon() = default;
  ConvexPolygon(std::initializer_list<glm::dvec2> vertices) {
    for (const glm::dvec2 vertex : vertices) add(vertex);
  }
  int size() const { return size_; }
  bool empty() const { return size_ < 3; }
  glm::dvec2 operator[](int i) const { return vertices_[static_cast<size_t>(i)]; }
  void add(glm::dvec2 vertex) { vertices_[static_cast<size_t>(size_++)] = vertex; }
  double area() const;
  /// Area of the part inside the unit circle around the origin, exact.
  double areaInUnitDisc() const;

 private:
  std::array<glm::dvec2, kCapacity> vertices_;
  int size_ = 0;
};

/// Distance within which a vertex counts as lying on a line. Coordinates are about 1, so it is some 500 times
/// the rounding of a line's equation; cutting that near an edge would only make slivers. An edge of length 2
/// moved by it changes the area by 2e-13.
inline constexpr double kOnLine = 1e-13;

/// Cuts a polygon in two; a part without area is empty.
void split(const ConvexPolygon& polygon, const HalfPlane& plane, ConvexPolygon& inside,
           ConvexPolygon& outside);

/// The convex region within all of some half-planes (at most 5).
struct ConvexRegion {
  std::array<HalfPlane, 5> planes;
  int count = 0;
  glm::dvec2 low{0.0}, high{0.0};  ///< bounds of its part in the pieces' square
  double area = 0.0;               ///< of that part
};

/// Disjoint convex polygons: the remainder of an area from which regions, possibly overlapping, are removed.
/// The area removed is that of the regions' union, exact up to rounding.
class ConvexPieces {
 public:
  explicit ConvexPieces(std::vector<ConvexPolygon> pieces) : pieces_(std::move(pieces)) {}
  void subtract(const ConvexRegion& region);
  bool empty() const { return pieces_.empty(); }
  const std::vector<ConvexPolygon>& pieces() const { return pieces_; }

 private:
  void keep(const ConvexPolygon& polygon);
  std::vector<ConvexPolygon> pieces_, next_;
};

}  // namespace limen::references

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/visibility_fields/position_map.h"

#include <algorithm>
#include <cmath>

#include "renderer/visibility_fields/map_functions.h"

namespace limen::visibility_fields {
namespace {

int segmentsFor(PositionForm form, int positions) {
  switch (form) {
    case PositionForm::Lattice:
      break;
    case PositionForm::Grid:
      return static_cast<int>(std::lround(std::sqrt(positions / 2.0)));
    case PositionForm::Box:
      return static_cast<int>(std::lround(std::sqrt(positions / 6.0)));
  }
  // positions = 2 (2 k^2 + 2 k + 1), so that k < sqrt(positions / 4) < k + 1.
  return static_cast<int>(std::sqrt(positions / 4.0));
}

/// The point whose angles asin(x), asin(y), asin(z) are as the coordinates of `ratios`: they are ratios times
/// the number for which the squares of the sines sum to 1, found by bisection.
glm::dvec3 latticePoint(glm::dvec3 ratios) {
  double low = 0.0, high = 0.5 * M_PI / std::max({ratios.x, ratios.y, ratios.z});
  for (int step = 0; step < 64; ++step) {
    const double middle = 0.5 * (low + high);
    const glm::dvec3 p = glm::sin(middle * ratios);
    (glm::dot(p, p) < 1.0 ? low : high) = middle;
  }
  return glm::normalize(glm::sin(low * ratios));
}

std::vector<glm::vec3> latticePoints(int k) {
  std::vector<glm::vec3> points(static_cast<size_t>(2 * (2 * k * k + 2 * k + 1)));
  for (int j = 0; j <= k; ++j)
    for (int i = 0; i + j <= k; ++i) {
      const glm::vec3 p(latticePoint(glm::dvec3(i, j, k - i - j)));
      for (const int x : {-1, 1})
        for (const int y : {-1, 1})
          for (const bool lower : {false, true})
            points[static_cast<size_t>(fieldLatticeIndex(x * i, y * j, lower, k))] =
                glm::vec3(float(x) * p.x, float(y) * p.y, lower ? -p.z : p.z);
    }
  return points;
}

std::vector<glm::vec3> gridPoints(int rows) {
  std::vector<glm::vec3> points;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < 2 * rows; ++column) {
      const double theta = M_PI * (row + 0.5) / rows, phi = M_PI * (column + 0.5) / rows;
      points.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    }
  return points;
}

/// Face f: axis f / 2, its negative side if f is odd.
std::vector<glm::vec3> boxPoints(int side) {
  std::vector<glm::vec3> points;
  for (int face = 0; face < 6; ++face)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) {
        glm::dvec3 p;
        p[face / 2] = face % 2 == 0 ? 1.0 : -1.0;
        p[(face / 2 + 1) % 3] = (2.0 * x + 1.0) / side - 1.0;
        p[(face / 2 + 2) % 3] = (2.0 * y + 1.0) / side - 1.0;
        points.emplace_back(glm::normalize(p));
      }
  return points;
}

/// The best of candidates, by the cosine.
class Best {
 public:
  Best(const std::vector<glm::vec3>& points, glm::vec3 direction) : points_(points), direction_(direction) {}
  void offer(int index) {
    const float cosine = glm::dot(points_[static_cast<size_t>(index)], direction_);
    if (cosine > cosine_) cosine_ = cosine, index_ = index;
  }
  int index() const { return index_; }

 private:
  const std::vector<glm::vec3>& points_;
  glm::vec3 direction_;
  float cosine_ = -2.0F;
  int index_ = 0;
};

/// Points lie in mirror images about the planes of the axes, so that the nearest is in the direction's own
/// octant.
int nearestOfLattice(const std::vector<glm::vec3>& points, glm::vec3 d, int k) {
  const glm::ivec2 cell(glm::floor(fieldLatticePlace(d, k)));
  Best best(points, glm::abs(d));
  glm::ivec2 found(0);
  int before = -1;
  for (int y = 0; y <= 1; ++y)
    for (int x = 0; x <= 1; ++x) {
      const glm::ivec2 at = cell + glm::ivec2(x, y);
      if (at.x + at.y > k) continue;
      best.offer(fieldLatticeIndex(at.x, at.y, false, k));
      if (best.index() != before) found = at, before = best.index();
    }
  return fieldLatticeIndex(d.x < 0.0F ? -found.x : found.x, d.y < 0.0F ? -found.y : found.y, d.z < 0.0F, k);
}

int nearestOfGrid(const std::vector<glm::vec3>& points, glm::vec3 d, int rows) {
  const float theta = std::atan2(std::hypot(d.x, d.y), d.z), phi = std::atan2(d.y, d.x);
  const int row = static_cast<int>(std::floor(theta / kFieldPi * float(rows)));
  const int column = static_cast<int>(std::floor(phi / kFieldPi * float(rows)));
  Best best(points, d);
  // In each row the nearest is the one of its column; rows farther away are farther than the nearest of
  // these.
  for (int at = std::max(row - 1, 0); at <= std::min(row + 1, rows - 1); ++at)
    best.offer(2 * rows * at + (column + 2 * rows) % (2 * rows));
  return best.index();
}

int nearestOfBox(const std::vector<glm::vec3>& points, glm::vec3 d, int side) {
  const glm::vec3 size = glm::abs(d);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const int face = 2 * axis + (d[axis] < 0.0F);
  const auto cellOf = [&](int other) {
    return static_cast<int>(std::floor((d[other % 3] / size[axis] + 1.0F) * 0.5F * float(side)));
  };
  const int x = cellOf(axis + 1), y = cellOf(axis + 2);
  Best best(points, d);
  // Faces lie in mirror images about the planes through their edges, so that the nearest is on the
  // direction's own.
  for (int j = std::max(y - 1, 0); j <= std::min(y + 1, side - 1); ++j)
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, side - 1); ++i)
      best.offer((face * side + j) * side + i);
  return best.index();
}

}  // namespace

PositionMap::PositionMap(PositionForm form, int positions)
    : form_(form), segments_(segmentsFor(form, positions)) {
  switch (form) {
    case PositionForm::Lattice:
      points_ = latticePoints(segments_);
      return;
    case PositionForm::Grid:
      points_ = gridPoints(segments_);
      return;
    case PositionForm::Box:
      points_ = boxPoints(segments_);
      return;
  }
}

int PositionMap::nearest(glm::vec3 direction) const {
  switch (form_) {
    case PositionForm::Lattice:
      break;
    case PositionForm::Grid:
      return nearestOfGrid(points_, direction, segments_);
    case PositionForm::Box:
      return nearestOfBox(points_, direction, segments_);
  }
  return nearestOfLattice(points_, direction, segments_);
}

}  // namespace limen::visibility_fields

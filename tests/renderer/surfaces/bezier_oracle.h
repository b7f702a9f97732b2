// SPDX-License-Identifier: BSD-3-Clause
// Patches evaluated by de Casteljau's algorithm in extended precision, and random ones to try.
#pragma once

#include <cmath>
#include <vector>

#include "renderer/scene/shapes.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::surfaces::oracle {

using Real = long double;
using Point3 = glm::vec<3, Real>;
using Point4 = glm::vec<4, Real>;

inline Point4 curve(std::vector<Point4> points, Real t) {
  for (size_t n = points.size() - 1; n > 0; --n)
    for (size_t i = 0; i < n; ++i) points[i] = (1 - t) * points[i] + t * points[i + 1];
  return points[0];
}

inline Point4 rectangle(const PatchSet& set, const Patch& patch, Real u, Real v) {
  std::vector<Point4> column;
  for (int j = 0; j <= patch.degreeV; ++j) {
    std::vector<Point4> row;
    for (int i = 0; i <= patch.degreeU; ++i)
      row.emplace_back(set.points.at(patch.firstPoint + uint32_t(i + (patch.degreeU + 1) * j)));
    column.push_back(curve(row, u));
  }
  return curve(column, v);
}

/// The points of a triangle in the order of patch_set.h: rows of falling i, in each rising k.
template <class Vector>
Vector triangle(std::vector<Vector> points, int n, Real u, Real v) {
  const auto at = [](int degree, int i, int k) {
    size_t place = 0;
    for (int row = degree; row > i; --row) place += size_t(degree - row) + 1;
    return place + size_t(k);
  };
  for (; n > 0; --n) {
    std::vector<Vector> next(size_t(n * (n + 1) / 2));
    for (int i = 0; i < n; ++i)
      for (int k = 0; i + k < n; ++k)
        next[at(n - 1, i, k)] =
            u * points[at(n, i + 1, k)] + v * points[at(n, i, k)] + (1 - u - v) * points[at(n, i, k + 1)];
    points = next;
  }
  return points[0];
}

inline Point3 position(const PatchSet& set, const Patch& patch, Real u, Real v) {
  Point4 p;
  if (patch.domain == Domain::Rectangle) {
    p = rectangle(set, patch, u, v);
  } else {
    const auto* first = set.points.data() + patch.firstPoint;
    p = triangle(std::vector<Point4>(first, first + patch.points()), patch.degreeU, u, v);
  }
  return Point3(p) / p.w;
}

/// Derivative of f at 0 by central differences with one step of Richardson's extrapolation.
template <class Function>
Point3 derivative(Function f, Real h) {
  const auto difference = [&](Real step) { return (f(step) - f(-step)) / (2 * step); };
  return (Real(4) * difference(h / 2) - difference(h)) / Real(3);
}

/// Coordinates in [-1, 1], weights log-uniform between 1 / range and range.
inline glm::dvec4 randomPoint(scene::Random& random, double range) {
  const glm::dvec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
  return weighted(p, std::pow(range, random.uniform(-1, 1)));
}

inline PatchSet randomPatch(scene::Random& random, Domain domain, int degreeU, int degreeV, double range) {
  PatchSet set;
  const int count =
      domain == Domain::Rectangle ? (degreeU + 1) * (degreeV + 1) : (degreeU + 1) * (degreeU + 2) / 2;
  std::vector<glm::dvec4> points;
  for (int i = 0; i < count; ++i) points.push_back(randomPoint(random, range));
  if (domain == Domain::Rectangle)
    addRectangle(set, degreeU, degreeV, points);
  else
    addTriangle(set, degreeU, points);
  return set;
}

}  // namespace limen::surfaces::oracle

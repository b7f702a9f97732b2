// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/patch_convert.h"

#include <algorithm>
#include <cassert>

#include "renderer/surfaces/bernstein.h"
#include "renderer/surfaces/patch_builder.h"

namespace limen::surfaces {
namespace {

using Polygon = std::vector<glm::dvec4>;

/// One degree more; the same bits backwards for the points backwards.
Polygon elevatedOnce(const Polygon& points) {
  const size_t n = points.size();  // the new degree
  Polygon out(n + 1);
  out[0] = points[0], out[n] = points[n - 1];
  for (size_t i = 1; i < n; ++i) out[i] = (double(i) * points[i - 1] + double(n - i) * points[i]) / double(n);
  return out;
}

Polygon elevatedTo(Polygon points, int degree) {
  while (static_cast<int>(points.size()) <= degree) points = elevatedOnce(points);
  return points;
}

/// Points with i counted along u, j along v.
std::vector<Polygon> rowsOf(const PatchSet& set, const Patch& patch) {
  std::vector<Polygon> rows;
  const auto* at = set.points.data() + patch.firstPoint;
  for (int j = 0; j <= patch.degreeV; ++j, at += patch.degreeU + 1)
    rows.emplace_back(at, at + patch.degreeU + 1);
  return rows;
}

std::vector<Polygon> transposed(const std::vector<Polygon>& rows) {
  std::vector<Polygon> out(rows[0].size(), Polygon(rows.size()));
  for (size_t j = 0; j < rows.size(); ++j)
    for (size_t i = 0; i < rows[j].size(); ++i) out[i][j] = rows[j][i];
  return out;
}

Polygon joined(const std::vector<Polygon>& rows) {
  Polygon out;
  for (const Polygon& row : rows) out.insert(out.end(), row.begin(), row.end());
  return out;
}

/// Control point (i, j, k) of the triangle over three corners of the unit square, whose coordinates are 0 or
/// 1: the mean, over all ways to hand m of the m + n arguments to u, of the rectangle's blossom, which at
/// zeros and ones is a control point.
glm::dvec4 blossomMean(const std::vector<Polygon>& rows, const std::array<glm::ivec2, 3>& corners, int i,
                       int j, int k) {
  const int m = static_cast<int>(rows[0].size()) - 1, n = static_cast<int>(rows.size()) - 1;
  const auto ways = [](int of, int choose) {
    return binomial(static_cast<size_t>(of), static_cast<size_t>(choose));
  };
  glm::dvec4 sum(0.0);
  for (int a = 0; a <= std::min(i, m); ++a)
    for (int b = 0; b <= std::min(j, m - a); ++b) {
      const int c = m - a - b;
      if (c > k) continue;
      const int onesU = a * corners[0].x + b * corners[1].x + c * corners[2].x,
                onesV = (i - a) * corners[0].y + (j - b) * corners[1].y + (k - c) * corners[2].y;
      sum +=
          ways(i, a) * ways(j, b) * ways(k, c) * rows[static_cast<size_t>(onesV)][static_cast<size_t>(onesU)];
    }
  return sum / ways(m + n, m);
}

}  // namespace

PatchSet elevated(const PatchSet& set, int degreeU, int degreeV) {
  assert(degreeU <= kMaxDegree && degreeV <= kMaxDegree);
  PatchSet out;
  out.normals = set.normals, out.neighbours = set.neighbours;
  for (const Patch& old : set.patches) {
    Patch patch = old;
    patch.firstPoint = static_cast<uint32_t>(out.points.size());
    Polygon points(set.points.begin() + old.firstPoint, set.points.begin() + old.firstPoint + old.points());
    if (old.domain == Domain::Rectangle) {
      patch.degreeU = std::max(old.degreeU, static_cast<uint8_t>(degreeU));
      patch.degreeV = std::max(old.degreeV, static_cast<uint8_t>(degreeV));
      std::vector<Polygon> rows = rowsOf(set, old);
      for (Polygon& row : rows) row = elevatedTo(row, patch.degreeU);
      std::vector<Polygon> columns = transposed(rows);
      for (Polygon& column : columns) column = elevatedTo(column, patch.degreeV);
      points = joined(transposed(columns));
    }
    out.points.insert(out.points.end(), points.begin(), points.end());
    out.patches.push_back(patch);
  }
  return out;
}

Patch triangleAsRectangle(const PatchSet& set, const Patch& patch, PatchSet& out) {
  assert(patch.domain == Domain::Triangle);
  const int n = patch.degreeU;
  std::vector<Polygon> rows;
  for (int j = 0; j <= n; ++j) {
    Polygon row;
    for (int i = 0; i <= n - j; ++i)
      row.push_back(set.points[patch.firstPoint + static_cast<uint32_t>(triangleIndex(n, i, n - i - j))]);
    rows.push_back(elevatedTo(row, n));
  }
  return addRectangle(out, n, n, joined(rows));
}

std::array<Patch, 2> rectangleAsTriangles(const PatchSet& set, const Patch& patch, PatchSet& out) {
  const int n = patch.degreeU + patch.degreeV;
  assert(patch.domain == Domain::Rectangle && n <= kMaxDegree);
  const std::vector<Polygon> rows = rowsOf(set, patch);
  const std::array<std::array<glm::ivec2, 3>, 2> halves = {
      {{glm::ivec2{0, 0}, {1, 0}, {1, 1}}, {glm::ivec2{0, 0}, {1, 1}, {0, 1}}}};
  std::array<Patch, 2> made;
  for (size_t half = 0; half < 2; ++half) {
    Polygon points;
    for (int i = n; i >= 0; --i)
      for (int k = 0; i + k <= n; ++k) points.push_back(blossomMean(rows, halves[half], i, n - i - k, k));
    made[half] = addTriangle(out, n, points);
  }
  return made;
}

}  // namespace limen::surfaces

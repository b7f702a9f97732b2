// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <stdexcept>

#include "renderer/surfaces/pattern_builder.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;

double turn(dvec2 a, dvec2 b, dvec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

double smallestAngle(const PatternMesh& mesh, glm::uvec3 t) {
  PatternMesh one;
  for (int k = 0; k < 3; ++k) one.points.push_back(mesh.points[t[k]]);
  one.triangles = {{0, 1, 2}};
  return shapeOf(Domain::Triangle, one).smallestAngleDeg;
}

/// Fills a counter-clockwise polygon by cutting off corners, each time the one with the largest smallest
/// angle. Between a straight side and the core's ragged one no order of two polylines does.
void fillPolygon(PatternMesh& mesh, Polyline polygon) {
  while (polygon.size() >= 3) {
    size_t best = polygon.size();
    double angle = -1.0;
    for (size_t k = 0; k < polygon.size(); ++k) {
      const uint32_t a = polygon[(k + polygon.size() - 1) % polygon.size()], b = polygon[k],
                     c = polygon[(k + 1) % polygon.size()];
      const auto at = [&](uint32_t i) { return mesh.points[i]; };
      const bool isEar =
          turn(at(a), at(b), at(c)) > 1e-12 && std::none_of(polygon.begin(), polygon.end(), [&](uint32_t p) {
            return p != a && p != b && p != c && turn(at(a), at(b), at(p)) > -1e-12 &&
                   turn(at(b), at(c), at(p)) > -1e-12 && turn(at(c), at(a), at(p)) > -1e-12;
          });
      if (!isEar) continue;
      if (const double own = smallestAngle(mesh, {a, b, c}); own > angle) angle = own, best = k;
    }
    if (best == polygon.size()) throw std::logic_error("a polygon without ears");
    const size_t n = polygon.size();
    mesh.triangles.emplace_back(polygon[(best + n - 1) % n], polygon[best], polygon[(best + 1) % n]);
    polygon.erase(polygon.begin() + static_cast<int64_t>(best));
  }
}

/// In the frame of the corner where the two sides with the largest factors meet: that corner is u = 1, sides
/// v = 0 and w = 0 start there, with factors n and m.
PatternMesh kumarInFrame(int m, int third, int n) {
  PatternMesh mesh;
  const std::array<Polyline, 3> sides = addSides(mesh, {m, third, n, 0});
  const double margin = 1.0 / (2.0 * std::min(m, n));
  const auto v = [&](int i) { return (i + 0.5) / m; };
  const auto w = [&](int j) { return (j + 0.5) / n; };
  // Largest i of row j within the margin; -1: none.
  const auto reach = [&](int j) {
    int i = -1;
    while (i < m + n && 1.0 - v(i + 1) - w(j) >= margin - 1e-12) ++i;
    return i;
  };
  // Of the faces between rows j and j + 1: last column below and above; no faces: below = 0.
  std::vector<glm::ivec2> bands;
  for (int j = 0; reach(j + 1) >= 0; ++j) {
    const int below = std::min(reach(j), reach(j + 1) + 1);
    if (below < 1) break;
    bands.emplace_back(below, std::min(reach(j), reach(j + 1)));
  }
  const auto rows = static_cast<int>(bands.size());
  std::vector<Polyline> grid(static_cast<size_t>(rows) + 1);
  for (int j = 0; j <= rows; ++j) {
    int last = 0;
    if (j < rows) last = bands[static_cast<size_t>(j)].x;
    if (j > 0) last = std::max(last, bands[static_cast<size_t>(j) - 1].y);
    for (int i = 0; i <= last; ++i)
      grid[static_cast<size_t>(j)].push_back(addPoint(mesh, {1.0 - v(i) - w(j), v(i)}));
  }
  const auto at = [&](int i, int j) { return grid[static_cast<size_t>(j)][static_cast<size_t>(i)]; };
  Polyline below, beyond, left;
  beyond.push_back(at(rows > 0 ? bands[0].x : 0, 0));
  for (int i = 0; i <= (rows > 0 ? bands[0].x : 0); ++i) below.push_back(at(i, 0));
  for (int j = 0; j < rows; ++j) {
    const glm::ivec2 band = bands[static_cast<size_t>(j)];
    for (int i = 0; i < band.x; ++i) {
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i, j + 1));
      if (i < band.y) mesh.triangles.emplace_back(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
    for (int i = band.y; i >= (j + 1 < rows ? bands[static_cast<size_t>(j) + 1].x : 0); --i)
      beyond.push_back(at(i, j + 1));
  }
  for (int j = rows; j >= 0; --j) left.push_back(at(0, j));
  stitch(mesh, sides[0], below);
  stitch(mesh, sides[2], left);
  Polyline polygon = sides[1];
  polygon.insert(polygon.end(), beyond.rbegin(), beyond.rend());
  fillPolygon(mesh, polygon);
  return mesh;
}

}  // namespace

PatternMesh kumarPattern(const Factors& f) {
  // The core's corner would lie on a side.
  if (std::max({f[0], f[1], f[2]}) == 1) return patternMesh(Domain::Triangle, f);
  const int smallest = static_cast<int>(std::min_element(f.begin(), f.begin() + 3) - f.begin());
  // The corner opposite to the side with the smallest factor.
  const size_t corner = static_cast<size_t>(smallest + 2) % 3;
  PatternMesh mesh = kumarInFrame(f[corner], f[(corner + 1) % 3], f[(corner + 2) % 3]);
  // Barycentric coordinates move on by so many corners.
  for (dvec2& p : mesh.points) {
    const std::array<double, 3> own = {p.x, p.y, 1.0 - p.x - p.y};
    p = {own[(3 - corner) % 3], own[(4 - corner) % 3]};
  }
  return mesh;
}

}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/other_patterns.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "renderer/surfaces/pattern_builder.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;

/// A closed ring: of each side its vertices, both corners included.
using Ring = std::vector<Polyline>;

/// `segments`: of each side, between the corners. Sides of no segments share one vertex.
Ring addRing(PatternMesh& mesh, const std::vector<dvec2>& corners, const std::vector<int>& segments) {
  const size_t sides = corners.size();
  Ring ring(sides);
  Polyline at;
  for (size_t i = 0; i < sides; ++i) {
    // Corners that coincide are one vertex.
    uint32_t same = static_cast<uint32_t>(mesh.points.size());
    for (size_t k = 0; k < i; ++k)
      if (glm::length(corners[k] - corners[i]) < 1e-12) same = at[k];
    at.push_back(same < mesh.points.size() ? same : addPoint(mesh, corners[i]));
  }
  for (size_t i = 0; i < sides; ++i) {
    ring[i].push_back(at[i]);
    for (int q = 1; q < segments[i]; ++q)
      ring[i].push_back(
          addPoint(mesh, glm::mix(corners[i], corners[(i + 1) % sides], double(q) / segments[i])));
    if (segments[i] > 0) ring[i].push_back(at[(i + 1) % sides]);
  }
  return ring;
}

PatternMesh concentricTriangle(const Factors& outer, int inner) {
  PatternMesh mesh;
  std::vector<int> segments(outer.begin(), outer.begin() + 3);
  if (inner == 1 && std::max({outer[0], outer[1], outer[2]}) > 1) inner = 2;
  const std::vector<dvec2> whole = {domainCorner(Domain::Triangle, 0), domainCorner(Domain::Triangle, 1),
                                    domainCorner(Domain::Triangle, 2)};
  Ring ring = addRing(mesh, whole, segments);
  for (int left = inner - 2, level = 1; left >= 0; left -= 2, ++level) {
    const double away = 2.0 * level / (3.0 * inner);
    std::vector<dvec2> corners;
    for (const dvec2 corner : whole) corners.push_back(corner + away * (dvec2(1.0) - 3.0 * corner));
    const Ring next = addRing(mesh, corners, {left, left, left});
    for (size_t side = 0; side < 3; ++side) stitch(mesh, ring[side], next[side]);
    ring = next;
  }
  if (inner % 2 == 1) mesh.triangles.emplace_back(ring[0][0], ring[1][0], ring[2][0]);
  return mesh;
}

PatternMesh concentricRectangle(const Factors& outer, glm::ivec2 inner) {
  PatternMesh mesh;
  const std::vector<dvec2> whole = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  const bool single = inner == glm::ivec2(1) && *std::max_element(outer.begin(), outer.end()) == 1;
  if (!single) inner = glm::max(inner, glm::ivec2(2));
  const Ring ring = addRing(mesh, whole, {outer.begin(), outer.end()});
  if (single) {
    mesh.triangles = {{ring[0][0], ring[1][0], ring[2][0]}, {ring[0][0], ring[2][0], ring[3][0]}};
    return mesh;
  }
  const int cols = inner.x - 2, rows = inner.y - 2;
  std::vector<Polyline> grid;
  for (int j = 0; j <= rows; ++j) {
    grid.emplace_back();
    for (int i = 0; i <= cols; ++i)
      grid.back().push_back(addPoint(mesh, {double(i + 1) / inner.x, double(j + 1) / inner.y}));
  }
  const auto at = [&](int i, int j) { return grid[static_cast<size_t>(j)][static_cast<size_t>(i)]; };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < cols; ++i) {
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  std::array<Polyline, 4> border;
  for (int i = 0; i <= cols; ++i) border[0].push_back(at(i, 0)), border[2].push_back(at(cols - i, rows));
  for (int j = 0; j <= rows; ++j) border[1].push_back(at(cols, j)), border[3].push_back(at(0, rows - j));
  for (size_t side = 0; side < 4; ++side) stitch(mesh, ring[side], border[side]);
  return mesh;
}

double angleDeg(dvec2 at, dvec2 a, dvec2 b) {
  const dvec2 p = a - at, q = b - at;
  return std::abs(std::atan2(p.x * q.y - p.y * q.x, glm::dot(p, q))) * 180.0 / std::numbers::pi;
}

}  // namespace

PatternMesh patternMesh(Domain domain, const Factors& factors, bool cornerFix) {
  const PatternPlan plan = patternOf(domain, factors, cornerFix);
  PatternMesh mesh;
  for (int slot = 0; slot < plan.vertices; ++slot) mesh.points.push_back(parametersOf(plan, slot));
  mesh.triangles = stripTriangles(patternIndices(plan));
  return mesh;
}

PatternMesh concentricPattern(Domain domain, const Factors& outer, glm::ivec2 inner) {
  return domain == Domain::Triangle ? concentricTriangle(outer, inner.x) : concentricRectangle(outer, inner);
}

PatternMesh moretonPattern(const Factors& f) {
  PatternMesh mesh;
  const int mu = std::max(f[0], f[2]), mv = std::max(f[1], f[3]);
  // Rows and columns that the sides with fewer segments replace.
  const int left = f[3] < mv ? 1 : 0, right = f[1] < mv ? 1 : 0, below = f[0] < mu ? 1 : 0,
            above = f[2] < mu ? 1 : 0;
  const int cols = mu - left - right, rows = mv - below - above;
  std::vector<Polyline> grid(static_cast<size_t>(rows) + 1);
  for (int j = 0; j <= rows; ++j)
    for (int i = 0; i <= cols; ++i)
      grid[static_cast<size_t>(j)].push_back(addPoint(mesh, {double(i + left) / mu, double(j + below) / mv}));
  const auto at = [&](int i, int j) { return grid[static_cast<size_t>(j)][static_cast<size_t>(i)]; };
  for (int j = 0; j < rows; ++j)
    for (int i = 0; i < cols; ++i) {
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  // Points of sides that are not the core's; corners are met twice and added once.
  const auto pointAt = [&](dvec2 p) {
    for (uint32_t k = 0; k < mesh.points.size(); ++k)
      if (glm::length(mesh.points[k] - p) < 1e-12) return k;
    return addPoint(mesh, p);
  };
  const auto side = [&](int which) {
    Polyline out;
    const dvec2 a = domainCorner(Domain::Rectangle, which),
                b = domainCorner(Domain::Rectangle, (which + 1) % 4);
    const int n = f[static_cast<size_t>(which)];
    for (int q = 0; q <= n; ++q) out.push_back(pointAt(glm::mix(a, b, double(q) / n)));
    return out;
  };
  std::array<Polyline, 4> border;
  for (int i = 0; i <= cols; ++i) border[0].push_back(at(i, 0)), border[2].push_back(at(cols - i, rows));
  for (int j = 0; j <= rows; ++j) border[1].push_back(at(cols, j)), border[3].push_back(at(0, rows - j));
  if (below) stitch(mesh, side(0), border[0]);
  if (right) stitch(mesh, side(1), border[1]);
  if (above) stitch(mesh, side(2), border[2]);
  if (left) stitch(mesh, side(3), border[3]);
  return mesh;
}

PatternShape shapeOf(Domain domain, const PatternMesh& mesh) {
  PatternShape out{180.0, mesh.points.size(), mesh.triangles.size()};
  const auto place = [&](uint32_t i) {
    const dvec2 p = mesh.points[i];
    return domain == Domain::Rectangle ? p : dvec2(p.x + 0.5 * p.y, p.y * std::sqrt(3.0) / 2.0);
  };
  for (const glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      out.smallestAngleDeg =
          std::min(out.smallestAngleDeg, angleDeg(place(t[k]), place(t[(k + 1) % 3]), place(t[(k + 2) % 3])));
  return out;
}

}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
// Patterns of triangles by Chung and Kim, Moreton and Bruijns.
#include <algorithm>

#include "renderer/surfaces/pattern_builder.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;

bool isUniform(const Factors& f) { return f[0] == f[1] && f[1] == f[2]; }

/// A uniform core: corner c has the barycentric coordinates 1 - 2 margin and twice margin. Its sides run as
/// the triangle's.
std::array<Polyline, 3> addCore(PatternMesh& mesh, int factor, double margin) {
  std::array<Polyline, 3> sides;
  const auto first = static_cast<uint32_t>(mesh.points.size());
  // Rows of constant u, from the corner u = 1: row r has r + 1 points, v falling along it.
  const auto at = [&](int row, int k) { return first + static_cast<uint32_t>(row * (row + 1) / 2 + k); };
  for (int row = 0; row <= factor; ++row)
    for (int k = 0; k <= row; ++k) {
      const double share = factor > 0 ? 1.0 / factor : 0.0, reach = 1.0 - 3.0 * margin;
      const dvec2 local = factor > 0 ? dvec2(factor - row, row - k) * share : dvec2(1.0 / 3.0);
      addPoint(mesh, factor > 0 ? margin + reach * local : local);
    }
  for (int row = 0; row < factor; ++row)
    for (int k = 0; k <= row; ++k) {
      mesh.triangles.emplace_back(at(row, k), at(row + 1, k), at(row + 1, k + 1));
      if (k < row) mesh.triangles.emplace_back(at(row, k), at(row + 1, k + 1), at(row, k + 1));
    }
  for (int q = 0; q <= factor; ++q) {
    sides[0].push_back(at(q, 0));
    sides[1].push_back(at(factor, q));
    sides[2].push_back(at(factor - q, factor - q));
  }
  return sides;
}

double lengthOf(const PatternMesh& mesh, uint32_t a, uint32_t b) {
  const auto place = [&](uint32_t i) {
    const dvec2 p = mesh.points[i];
    return dvec2(p.x + 0.5 * p.y, p.y * std::sqrt(3.0) / 2.0);
  };
  return glm::length(place(a) - place(b));
}

/// Flips the edge between two vertices if it is the longest of both of its triangles.
void flipIfLongest(PatternMesh& mesh, uint32_t a, uint32_t b) {
  // The triangle to the left of a -> b and of b -> a, and its third vertex.
  std::array<glm::uvec3*, 2> triangles{};
  std::array<uint32_t, 2> thirds{};
  for (glm::uvec3& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const uint32_t from = t[k], to = t[(k + 1) % 3];
      if (from == a && to == b) triangles[0] = &t, thirds[0] = t[(k + 2) % 3];
      if (from == b && to == a) triangles[1] = &t, thirds[1] = t[(k + 2) % 3];
    }
  if (!triangles[0] || !triangles[1]) return;
  // Equal but for rounding is not longest.
  const double own = lengthOf(mesh, a, b) * (1.0 - 1e-9);
  for (const uint32_t third : thirds)
    if (lengthOf(mesh, a, third) >= own || lengthOf(mesh, b, third) >= own) return;
  *triangles[0] = {a, thirds[1], thirds[0]};
  *triangles[1] = {thirds[1], b, thirds[0]};
}

/// As many triangles as a strip can join in the middle of the polyline with more segments; the rest of it is
/// joined to the ends of the other one by fans.
void stitchCentre(PatternMesh& mesh, const Polyline& outer, const Polyline& inner) {
  const size_t n = outer.size() - 1, m = inner.size() - 1;
  const bool outerHasMore = n >= m;
  const Polyline &more = outerHasMore ? outer : inner, &less = outerHasMore ? inner : outer;
  const size_t before = (more.size() - less.size()) / 2, segments = less.size() - 1;
  const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
    // (a, b) lies on `more`, or c and b on `less`: counter-clockwise if `more` is the outer one.
    if (outerHasMore)
      mesh.triangles.emplace_back(a, b, c);
    else
      mesh.triangles.emplace_back(b, a, c);
  };
  for (size_t k = 0; k < before; ++k) add(more[k], more[k + 1], less[0]);
  for (size_t k = 0; k < segments; ++k) {
    add(more[before + k], more[before + k + 1], less[k]);
    add(less[k], more[before + k + 1], less[k + 1]);
  }
  for (size_t k = before + segments; k + 1 < more.size(); ++k) add(more[k], more[k + 1], less.back());
}

}  // namespace

PatternMesh chungKimPattern(const Factors& factors) {
  if (isUniform(factors)) return patternMesh(Domain::Triangle, factors);
  const int most = std::max({factors[0], factors[1], factors[2]});
  PatternMesh mesh;
  const std::array<Polyline, 3> sides = addSides(mesh, factors),
                                core = addCore(mesh, most - 2, 2.0 / (3.0 * most));
  for (size_t s = 0; s < 3; ++s) stitch(mesh, sides[s], core[s]);
  for (size_t s = 0; s < 3; ++s) flipIfLongest(mesh, sides[s][0], core[s][0]);
  return mesh;
}

PatternMesh collapsedPattern(const Factors& factors, int base) {
  const auto b = static_cast<size_t>(base);
  PatternMesh mesh;
  std::array<Polyline, 3> sides = addSides(mesh, factors);
  // From the base upwards.
  Polyline &right = sides[(b + 1) % 3], &left = sides[(b + 2) % 3];
  std::reverse(left.begin(), left.end());
  const size_t columns = sides[b].size() - 1, rows = std::max(left.size(), right.size()) - 1;
  const dvec2 from = domainCorner(Domain::Triangle, base),
              to = domainCorner(Domain::Triangle, (base + 1) % 3),
              top = domainCorner(Domain::Triangle, (base + 2) % 3);
  // Lines of the core that end in the apex; a side with fewer segments takes the place of the outermost one.
  std::vector<Polyline> core;
  for (size_t i = left.size() <= rows ? 1 : 0; i <= columns - (right.size() <= rows ? 1 : 0); ++i) {
    if (i == 0 || i == columns) {
      core.push_back(i == 0 ? left : right);
      continue;
    }
    core.emplace_back();
    const dvec2 foot = glm::mix(from, to, double(i) / double(columns));
    for (size_t j = 0; j < rows; ++j)
      core.back().push_back(j == 0 ? sides[b][i]
                                   : addPoint(mesh, glm::mix(foot, top, double(j) / double(rows))));
    core.back().push_back(left.back());
  }
  for (size_t i = 0; i + 1 < core.size(); ++i)
    for (size_t j = 0; j < rows; ++j) {
      mesh.triangles.emplace_back(core[i][j], core[i + 1][j], core[i + 1][j + 1]);
      if (j + 1 < rows) mesh.triangles.emplace_back(core[i][j], core[i + 1][j + 1], core[i][j + 1]);
    }
  // Without the apex, to which the last triangle of the core's line leads: others with it would lie on a
  // line.
  if (left.size() <= rows) {
    Polyline inner = core.front();
    std::reverse(inner.begin(), inner.end());
    std::reverse(left.begin(), left.end());
    left.erase(left.begin());
    stitch(mesh, left, inner);
  }
  if (right.size() <= rows) {
    right.pop_back();
    stitch(mesh, right, core.back());
  }
  return mesh;
}

PatternMesh bruijnsPattern(BruijnsScheme scheme, const Factors& factors) {
  const auto begin = factors.begin(), end = factors.begin() + 3;
  if (scheme == BruijnsScheme::Fixed) {
    const int most = *std::max_element(begin, end);
    return patternMesh(Domain::Triangle, {most, most, most, most});
  }
  const auto least = std::min_element(begin, end);
  if (scheme == BruijnsScheme::ConstantMaximum)
    return collapsedPattern(factors, static_cast<int>(least - begin));
  PatternMesh mesh;
  const std::array<Polyline, 3> sides = addSides(mesh, factors);
  if (*least < 4) {
    const uint32_t middle = addPoint(mesh, dvec2(1.0 / 3.0));
    for (const Polyline& side : sides)
      for (size_t k = 0; k + 1 < side.size(); ++k) mesh.triangles.emplace_back(side[k], side[k + 1], middle);
    return mesh;
  }
  std::array<Polyline, 3> core = addCore(mesh, *least - 3, 1.0 / *least);
  std::array<uint32_t, 3> between{};
  for (size_t c = 0; c < 3; ++c)
    between[c] = addPoint(mesh, 0.5 * (mesh.points[sides[c][0]] + mesh.points[core[c][0]]));
  for (size_t s = 0; s < 3; ++s) {
    Polyline inner = {between[s]};
    inner.insert(inner.end(), core[s].begin(), core[s].end());
    inner.push_back(between[(s + 1) % 3]);
    stitchCentre(mesh, sides[s], inner);
  }
  return mesh;
}

}  // namespace limen::surfaces

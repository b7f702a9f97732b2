// SPDX-License-Identifier: BSD-3-Clause
// What generators of patterns are made of.
#pragma once

#include "renderer/surfaces/other_patterns.h"

namespace limen::surfaces {

using Polyline = std::vector<uint32_t>;  ///< of PatternMesh::points

inline glm::dvec2 domainCorner(Domain domain, int corner) {
  if (domain == Domain::Triangle)
    return corner == 0 ? glm::dvec2(1, 0) : corner == 1 ? glm::dvec2(0, 1) : glm::dvec2(0);
  return {corner == 1 || corner == 2 ? 1.0 : 0.0, corner >= 2 ? 1.0 : 0.0};
}

inline uint32_t addPoint(PatternMesh& mesh, glm::dvec2 point) {
  mesh.points.push_back(point);
  return static_cast<uint32_t>(mesh.points.size() - 1);
}

/// Triangles between two polylines that run the same way, `inner` to the left of `outer`.
inline void stitch(PatternMesh& mesh, const Polyline& outer, const Polyline& inner) {
  const int n = static_cast<int>(outer.size()) - 1, m = static_cast<int>(inner.size()) - 1;
  for (int step = 0, a = 0; step < n + m; ++step) {
    const int next = patternInnerSteps(step + 1, m, n), b = step - a;
    const auto at = [](const Polyline& line, int i) { return line[static_cast<size_t>(i)]; };
    if (next > a)
      mesh.triangles.emplace_back(at(inner, a), at(outer, b), at(inner, a + 1));
    else
      mesh.triangles.emplace_back(at(outer, b), at(outer, b + 1), at(inner, a));
    a = next;
  }
}

/// The three sides of a triangle, both corners included; corners are shared.
inline std::array<Polyline, 3> addSides(PatternMesh& mesh, const Factors& factors) {
  std::array<Polyline, 3> out;
  std::array<uint32_t, 3> corners{};
  for (int c = 0; c < 3; ++c)
    corners[static_cast<size_t>(c)] = addPoint(mesh, domainCorner(Domain::Triangle, c));
  for (size_t s = 0; s < 3; ++s) {
    const uint32_t from = corners[s], to = corners[(s + 1) % 3];
    out[s].push_back(from);
    for (int q = 1; q < factors[s]; ++q)
      out[s].push_back(addPoint(mesh, glm::mix(mesh.points[from], mesh.points[to], double(q) / factors[s])));
    out[s].push_back(to);
  }
  return out;
}

}  // namespace limen::surfaces

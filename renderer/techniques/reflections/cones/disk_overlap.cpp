// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/cones/disk_overlap.h"

#include <algorithm>
#include <cmath>

namespace limen::techniques {
namespace {

double cross2(glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; }

/// Area and first moment, both signed.
struct Sums {
  double area = 0.0;
  glm::dvec2 moment{0.0};
};

void addTriangle(Sums& sums, glm::dvec2 p, glm::dvec2 q) {
  const double area = 0.5 * cross2(p, q);
  sums.area += area;
  sums.moment += area * (p + q) / 3.0;
}

/// The sector between the directions of p and q.
void addSector(Sums& sums, glm::dvec2 p, glm::dvec2 q) {
  const double first = std::atan2(p.y, p.x), turn = std::atan2(cross2(p, q), glm::dot(p, q)),
               last = first + turn;
  sums.area += 0.5 * turn;
  sums.moment += glm::dvec2(std::sin(last) - std::sin(first), std::cos(first) - std::cos(last)) / 3.0;
}

/// What the triangle (0, p, q) has in common with the disk.
void addEdge(Sums& sums, glm::dvec2 p, glm::dvec2 q) {
  const glm::dvec2 edge = q - p;
  const double a = glm::dot(edge, edge), b = glm::dot(p, edge);
  if (a == 0.0) return;
  // The chord lies from `low` to `high` along the edge's line.
  const double beyond = 1.0 - cross2(p, edge) * cross2(p, edge) / a;
  const double half = beyond > 0.0 ? std::sqrt(beyond / a) : -1.0;
  const double low = std::clamp(-b / a - half, 0.0, 1.0), high = std::clamp(-b / a + half, 0.0, 1.0);
  if (half <= 0.0 || low >= high) return addSector(sums, p, q);
  const glm::dvec2 in = p + low * edge, out = p + high * edge;
  if (low > 0.0) addSector(sums, p, in);
  addTriangle(sums, in, out);
  if (high < 1.0) addSector(sums, out, q);
}

}  // namespace

DiskOverlap diskOverlapByEdges(std::span<const glm::dvec2> polygon) {
  if (polygon.size() < 3) return {};
  Sums sums;
  // A small figure inside loses digits unless it is measured from one of its own corners.
  const bool inside =
      std::all_of(polygon.begin(), polygon.end(), [](glm::dvec2 p) { return glm::dot(p, p) <= 1.0; });
  const glm::dvec2 from = inside ? polygon[0] : glm::dvec2(0.0);
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec2 p = polygon[i], q = polygon[(i + 1) % polygon.size()];
    if (inside)
      addTriangle(sums, p - from, q - from);
    else
      addEdge(sums, p, q);
  }
  if (sums.area == 0.0 || !std::isfinite(sums.area)) return {};
  const DiskOverlap out{std::abs(sums.area), from + sums.moment / sums.area};
  // Rounding alone leaves less than this of a figure that does not meet the disk.
  if (!inside && out.area < 1e-15) return {};
  return out;
}

}  // namespace limen::techniques

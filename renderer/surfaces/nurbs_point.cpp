// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/nurbs_point.h"

#include <algorithm>

namespace limen::surfaces {
namespace {

/// The basis functions of one direction that are not 0 at a parameter.
struct Span {
  size_t first = 0;  ///< control point of the first function
  std::array<double, kMaxDegree + 1> basis{};
};

Span spanAt(const std::vector<double>& knots, int degree, int points, double t) {
  const auto p = static_cast<size_t>(degree), count = static_cast<size_t>(points);
  t = std::clamp(t, knots[p], knots[count]);
  // The last knot not above t that begins a span with a length.
  const auto end = knots.begin() + static_cast<long>(count) + 1;
  auto at = std::upper_bound(knots.begin() + static_cast<long>(p), end, t);
  if (at == end) at = std::lower_bound(knots.begin() + static_cast<long>(p), end, t);
  const auto k = static_cast<size_t>(at - knots.begin()) - 1;
  Span out;
  out.first = k - p;
  // Cox and de Boor's recursion, row by row.
  out.basis[0] = 1.0;
  for (size_t r = 1; r <= p; ++r) {
    double carried = 0.0;
    for (size_t j = 0; j < r; ++j) {
      const double low = knots[k + 1 + j - r], high = knots[k + 1 + j];
      const double share = out.basis[j] / (high - low);
      out.basis[j] = carried + (high - t) * share;
      carried = (t - low) * share;
    }
    out.basis[r] = carried;
  }
  return out;
}

glm::dvec4 combined(const NurbsSurface& surface, const Span& u, const Span& v) {
  glm::dvec4 sum(0.0);
  const auto width = static_cast<size_t>(surface.pointsU());
  for (size_t j = 0; j <= static_cast<size_t>(surface.degreeV); ++j) {
    glm::dvec4 row(0.0);
    for (size_t i = 0; i <= static_cast<size_t>(surface.degreeU); ++i)
      row += u.basis[i] * surface.points[u.first + i + width * (v.first + j)];
    sum += v.basis[j] * row;
  }
  return sum;
}

}  // namespace

glm::dvec4 nurbsPoint(const NurbsSurface& surface, double u, double v) {
  return combined(surface, spanAt(surface.knotsU, surface.degreeU, surface.pointsU(), u),
                  spanAt(surface.knotsV, surface.degreeV, surface.pointsV(), v));
}

std::vector<glm::dvec4> nurbsGrid(const NurbsSurface& surface, const std::vector<double>& u,
                                  const std::vector<double>& v) {
  std::vector<Span> spans;
  for (const double t : u) spans.push_back(spanAt(surface.knotsU, surface.degreeU, surface.pointsU(), t));
  std::vector<glm::dvec4> out;
  out.reserve(u.size() * v.size());
  for (const double t : v) {
    const Span row = spanAt(surface.knotsV, surface.degreeV, surface.pointsV(), t);
    for (const Span& column : spans) out.push_back(combined(surface, column, row));
  }
  return out;
}

}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/nurbs.h"

#include <algorithm>
#include <stdexcept>

#include "renderer/surfaces/patch_builder.h"

namespace limen::surfaces {
namespace {

/// Spans with a length: the index of the knot where each begins.
std::vector<size_t> spansOf(const std::vector<double>& knots, int degree, size_t points) {
  const auto p = static_cast<size_t>(degree);
  if (degree < 1 || degree > kMaxDegree || points <= p || knots.size() != points + p + 1 ||
      !std::is_sorted(knots.begin(), knots.end()))
    throw std::invalid_argument("the knots of a NURBS surface do not fit its degree and points");
  std::vector<size_t> spans;
  for (size_t k = p; k < points; ++k)
    if (knots[k] < knots[k + 1]) spans.push_back(k);
  for (size_t s = 1; s < spans.size(); ++s)
    if (spans[s] - spans[s - 1] > p) throw std::invalid_argument("a knot of a NURBS surface tears it");
  if (spans.empty()) throw std::invalid_argument("a NURBS surface has no span");
  return spans;
}

/// Blossom of span k at `last` arguments that are its end and otherwise its beginning: what remains of the
/// polygon once these knots are inserted (Boehm's algorithm, all at once).
glm::dvec4 blossom(const std::vector<double>& knots, int degree, const std::vector<glm::dvec4>& points,
                   size_t k, int last) {
  const auto p = static_cast<size_t>(degree);
  std::vector<glm::dvec4> d(points.begin() + static_cast<long>(k - p),
                            points.begin() + static_cast<long>(k) + 1);
  for (size_t r = 1; r <= p; ++r) {
    const double x = knots[static_cast<int>(r) <= degree - last ? k : k + 1];
    for (size_t j = p; j >= r; --j) {
      const double low = knots[k - p + j], high = knots[k + 1 + j - r], share = (x - low) / (high - low);
      d[j] = (1.0 - share) * d[j - 1] + share * d[j];
    }
  }
  return d[p];
}

/// Control points of all spans in a row, common ends once.
std::vector<glm::dvec4> bezierRow(const std::vector<double>& knots, int degree,
                                  const std::vector<glm::dvec4>& points, const std::vector<size_t>& spans) {
  std::vector<glm::dvec4> out{blossom(knots, degree, points, spans[0], 0)};
  for (const size_t k : spans)
    for (int last = 1; last <= degree; ++last) out.push_back(blossom(knots, degree, points, k, last));
  return out;
}

}  // namespace

PatchSet nurbsPatches(const NurbsSurface& surface) {
  const int m = surface.degreeU, n = surface.degreeV;
  const size_t rowLength = surface.pointsU() > 0 ? static_cast<size_t>(surface.pointsU()) : 0,
               rows = surface.pointsV() > 0 ? static_cast<size_t>(surface.pointsV()) : 0;
  const std::vector<size_t> spansU = spansOf(surface.knotsU, m, rowLength),
                            spansV = spansOf(surface.knotsV, n, rows);
  if (surface.points.size() != rowLength * rows)
    throw std::invalid_argument("the points of a NURBS surface do not fit its knots");
  const size_t width = spansU.size() * static_cast<size_t>(m) + 1;
  std::vector<std::vector<glm::dvec4>> columns(width, std::vector<glm::dvec4>(rows));
  for (size_t j = 0; j < rows; ++j) {
    const auto first = surface.points.begin() + static_cast<long>(j * rowLength);
    const std::vector<glm::dvec4> row =
        bezierRow(surface.knotsU, m, {first, first + static_cast<long>(rowLength)}, spansU);
    for (size_t i = 0; i < width; ++i) columns[i][j] = row[i];
  }
  for (std::vector<glm::dvec4>& column : columns) column = bezierRow(surface.knotsV, n, column, spansV);
  PatchSet set;
  for (size_t t = 0; t < spansV.size(); ++t)
    for (size_t s = 0; s < spansU.size(); ++s) {
      std::vector<glm::dvec4> net;
      for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= m; ++i)
          net.push_back(columns[s * static_cast<size_t>(m) + static_cast<size_t>(i)]
                               [t * static_cast<size_t>(n) + static_cast<size_t>(j)]);
      addRectangle(set, m, n, net);
    }
  return set;
}

PatchSet trimmedNurbsPatches(const NurbsSurface& surface, TrimRegion region) {
  PatchSet set = nurbsPatches(surface);
  const auto ends = [](const std::vector<double>& knots, int degree, int points) {
    const double low = knots[static_cast<size_t>(degree)], length = knots[static_cast<size_t>(points)] - low;
    std::vector<glm::dvec2> out;
    for (const size_t k : spansOf(knots, degree, static_cast<size_t>(points)))
      out.emplace_back((knots[k] - low) / length, (knots[k + 1] - low) / length);
    return out;
  };
  for (const glm::dvec2 v : ends(surface.knotsV, surface.degreeV, surface.pointsV()))
    for (const glm::dvec2 u : ends(surface.knotsU, surface.degreeU, surface.pointsU()))
      set.trimOf.push_back({0, {u.x, v.x}, {u.y, v.y}});
  set.trims.push_back(std::move(region));
  return set;
}

}  // namespace limen::surfaces

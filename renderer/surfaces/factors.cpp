// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/factors.h"

#include <algorithm>
#include <limits>

namespace limen::surfaces {

namespace {

using glm::dvec3;
using glm::dvec4;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// Middle of the box of the finite control points, and their largest distance from `centre` after moving.
struct Extent {
  dvec3 centre{0.0};
  double radius = 0.0, weight = kInfinite;
};

Extent extentOf(const dvec4* points, int count, bool recentre) {
  Extent out;
  dvec3 low(kInfinite), high(-kInfinite);
  for (int i = 0; i < count; ++i) {
    out.weight = std::min(out.weight, points[i].w);
    if (points[i].w == 0.0) continue;
    const dvec3 p = dvec3(points[i]) / points[i].w;
    low = glm::min(low, p), high = glm::max(high, p);
  }
  if (recentre && low.x <= high.x) out.centre = 0.5 * (low + high);
  for (int i = 0; i < count; ++i)
    if (points[i].w != 0.0)
      out.radius = std::max(out.radius, glm::length(dvec3(points[i]) / points[i].w - out.centre));
  return out;
}

}  // namespace

DerivativeBounds derivativeBounds(const PatchSet& set, const Patch& patch, double eps, bool recentre) {
  const dvec4* points = &set.points[patch.firstPoint];
  const int m = patch.degreeU, n = patch.degreeV;
  const Extent extent = extentOf(points, patch.points(), recentre);
  const double reach = std::max(extent.radius - eps, 0.0);
  const auto at = [&](int i, int j) {
    const dvec4 p = points[i + (m + 1) * j];
    return dvec4(dvec3(p) - p.w * extent.centre, p.w);
  };
  const auto size = [&](dvec4 d) { return glm::length(dvec3(d)) + reach * std::abs(d.w); };
  DerivativeBounds out;
  out.weight = extent.weight;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i + 2 <= m; ++i)
      out.uu = std::max(out.uu, m * (m - 1) * size(at(i + 2, j) - 2.0 * at(i + 1, j) + at(i, j)));
  for (int j = 0; j + 2 <= n; ++j)
    for (int i = 0; i <= m; ++i)
      out.vv = std::max(out.vv, n * (n - 1) * size(at(i, j + 2) - 2.0 * at(i, j + 1) + at(i, j)));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i)
      out.uv = std::max(out.uv, m * n * size(at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j)));
  return out;
}

dvec2 segmentsOf(const DerivativeBounds& bounds, double eps, FactorRule rule) {
  if (!(bounds.weight > 0.0) || !(eps > 0.0)) return dvec2(kInfinite);
  return segmentsFor(bounds.uu, bounds.uv, bounds.vv, 8.0 * eps * bounds.weight, static_cast<int>(rule));
}

std::array<double, 3> triangleSegments(const PatchSet& set, const Patch& patch, double eps) {
  const int n = patch.degreeU;
  const dvec4* points = &set.points[patch.firstPoint];
  const auto at = [&](int i, int k) { return dvec3(points[(n - i) * (n - i + 1) / 2 + k]); };
  // Differences along the three sides; b(i, k) with j = n - i - k.
  double d11 = 0, d22 = 0, d33 = 0, d13 = 0, d21 = 0, d32 = 0;
  const auto raise = [&](double& of, dvec3 d) { of = std::max(of, n * (n - 1) * glm::length(d)); };
  for (int i = 0; i <= n - 2; ++i)
    for (int k = 0; i + k <= n - 2; ++k) {
      const dvec3 uu = at(i + 2, k), vv = at(i, k), ww = at(i, k + 2), uv = at(i + 1, k), vw = at(i, k + 1),
                  wu = at(i + 1, k + 1);
      raise(d11, vv - 2.0 * uv + uu);
      raise(d22, ww - 2.0 * vw + vv);
      raise(d33, uu - 2.0 * wu + ww);
      raise(d13, vw - uv - wu + uu);
      raise(d21, wu - vw - uv + vv);
      raise(d32, uv - wu - vw + ww);
    }
  const auto segments = [&](double own, double a, double b) {
    return std::max(1.0, std::sqrt((own + std::max(a, b)) / (4.0 * eps)));
  };
  return {segments(d11, d13, d21), segments(d22, d21, d32), segments(d33, d13, d32)};
}

double constantOf(PnBound bound) {
  return bound == PnBound::Boundary ? 9.0 / 4 : bound == PnBound::Tied ? 39.0 / 4 : 45.0 / 4;
}

double largestTangentDistance(const PatchSet& set, const Patch& patch) {
  const dvec4* points = &set.points[patch.firstPoint];
  const auto at = [&](int i, int k) { return dvec3(points[(3 - i) * (4 - i) / 2 + k]); };
  const auto distance = [](dvec3 p, dvec3 a, dvec3 b) {
    const dvec3 along = b - a;
    const double length2 = glm::dot(along, along);
    const dvec3 away = p - a;
    return glm::length(length2 > 0.0 ? away - along * (glm::dot(away, along) / length2) : away);
  };
  const dvec3 u = at(3, 0), v = at(0, 0), w = at(0, 3);
  return std::max({distance(at(2, 0), u, v), distance(at(1, 0), u, v), distance(at(0, 1), v, w),
                   distance(at(0, 2), v, w), distance(at(1, 2), w, u), distance(at(2, 1), w, u)});
}

double pnSegments(const PatchSet& set, const Patch& patch, double eps, PnBound bound) {
  const double distance = largestTangentDistance(set, patch);
  return distance <= eps ? 1.0 : std::sqrt(constantOf(bound) * distance / eps);
}

double sizeOf(CurveSize size, std::span<const glm::dvec3> points) {
  if (points.size() < 2) return 0.0;
  if (size == CurveSize::Chord) return glm::length(points.back() - points.front());
  const double degree = static_cast<double>(points.size() - 1);
  double longest = 0.0;
  dvec3 most(0.0);
  for (size_t i = 1; i < points.size(); ++i) {
    const dvec3 d = degree * (points[i] - points[i - 1]);
    longest = std::max(longest, glm::length(d));
    most = glm::max(most, glm::abs(d));
  }
  return size == CurveSize::Rockwood ? longest : glm::length(most);
}

int wholeFactor(double segments, int most, bool* capped) {
  if (capped && !(segments <= most)) *capped = true;
  return segments <= most ? std::max(1, static_cast<int>(std::ceil(segments))) : most;
}

double objectTolerance(double px, double depth, double tanHalfFov, int heightPx, double tanOffAxis) {
  return px * 2.0 * tanHalfFov * depth / heightPx / std::sqrt(1.0 + tanOffAxis * tanOffAxis);
}

}  // namespace limen::surfaces

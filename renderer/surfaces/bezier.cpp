// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/bezier.h"

#include <algorithm>

#include "renderer/surfaces/bernstein.h"

namespace limen::surfaces {
namespace {

constexpr size_t kMaxTrianglePoints = (kMaxDegree + 1) * (kMaxDegree + 2) / 2;

/// Point and derivatives of a curve whose control points are point(0) to point(n).
template <class Point>
std::array<glm::dvec4, 3> curveJet(int n, const std::array<Basis, 3>& bases, Order order, Point point) {
  std::array<glm::dvec4, 3> out{bezierSum(n, bases[0], point), glm::dvec4(0.0), glm::dvec4(0.0)};
  if (order != Order::Position)
    out[1] = double(n) * bezierSum(n - 1, bases[1], [&](int i) { return point(i + 1) - point(i); });
  if (order == Order::Second && n > 1)
    out[2] = double(n * (n - 1)) *
             bezierSum(n - 2, bases[2], [&](int i) { return point(i + 2) - 2.0 * point(i + 1) + point(i); });
  return out;
}

std::array<Basis, 3> bases(int n, double t, double s, Order order) {
  std::array<Basis, 3> out{bernstein(n, t, s)};
  if (order != Order::Position) out[1] = bernstein(n - 1, t, s);
  if (order == Order::Second && n > 1) out[2] = bernstein(n - 2, t, s);
  return out;
}

/// Rows of constant j are collapsed first; then their points and derivatives along v.
HomogeneousJet rectangleJet(const Patch& patch, const glm::dvec4* points, const DomainPoint& at,
                            Order order) {
  const int m = patch.degreeU, n = patch.degreeV;
  const std::array<Basis, 3> alongU = bases(m, at.u, at.restU, order),
                             alongV = bases(n, at.v, at.restV, order);
  std::array<std::array<glm::dvec4, 3>, kMaxDegree + 1> rows;
  for (int j = 0; j <= n; ++j)
    rows[static_cast<size_t>(j)] = curveJet(m, alongU, order, [&](int i) { return points[i + (m + 1) * j]; });
  const auto column = [&](size_t derivative, Order upTo) {
    return curveJet(n, alongV, upTo, [&](int j) { return rows[static_cast<size_t>(j)][derivative]; });
  };
  HomogeneousJet out;
  const auto [p, v, vv] = column(0, order);
  out.p = p, out.v = v, out.vv = vv;
  if (order == Order::Position) return out;
  const auto [u, uv, unused] = column(1, order == Order::Second ? Order::First : Order::Position);
  out.u = u, out.uv = uv;
  if (order == Order::Second) out.uu = column(2, Order::Position)[0];
  return out;
}

/// Sum of point(i, j, k) times the Bernstein polynomials of degree n. Terms of the boundary are grouped so
/// that on each side the sum is that of bezierSum() bit by bit, in either direction; the others are 0 there.
template <class Vector>
Vector triangleSum(int n, const Vector* points, const DomainPoint& at) {
  const Powers u = powers(at.u, n), v = powers(at.v, n), w = powers(at.w(), n);
  const auto term = [&](int i, int j, int k) {
    const auto a = static_cast<size_t>(i), b = static_cast<size_t>(j), c = static_cast<size_t>(k);
    const double coefficient = binomial(static_cast<size_t>(n), a) * binomial(b + c, b);
    return points[triangleIndex(n, i, k)] * (coefficient * (u[a] * v[b] * w[c]));
  };
  if (n == 0) return points[0];
  Vector sum = term(n, 0, 0) + term(0, n, 0) + term(0, 0, n);
  for (int i = 1; 2 * i < n; ++i)
    sum += (term(n - i, i, 0) + term(i, n - i, 0)) + (term(0, n - i, i) + term(0, i, n - i)) +
           (term(i, 0, n - i) + term(n - i, 0, i));
  if (const int h = n / 2; n % 2 == 0) sum += term(h, h, 0) + term(0, h, h) + term(h, 0, h);
  for (int i = 1; i < n; ++i)
    for (int j = 1; i + j < n; ++j) sum += term(i, j, n - i - j);
  return sum;
}

/// Control points of the derivative along w -> u or, otherwise, w -> v.
enum class Towards { U, V };
template <class Vector>
std::array<Vector, kMaxTrianglePoints> derivativeNet(int n, const Vector* points, Towards towards) {
  std::array<Vector, kMaxTrianglePoints> out;
  for (int i = 0; i < n; ++i)
    for (int k = 0; i + k < n; ++k) {
      const Vector to =
          towards == Towards::U ? points[triangleIndex(n, i + 1, k)] : points[triangleIndex(n, i, k)];
      out[static_cast<size_t>(triangleIndex(n - 1, i, k))] =
          double(n) * (to - points[triangleIndex(n, i, k + 1)]);
    }
  return out;
}

}  // namespace

template <class Vector>
Jet<Vector> triangleJet(int n, const Vector* points, const DomainPoint& at, Order order) {
  Jet<Vector> out;
  out.p = triangleSum(n, points, at);
  if (order == Order::Position || n == 0) return out;
  const auto u = derivativeNet(n, points, Towards::U), v = derivativeNet(n, points, Towards::V);
  out.u = triangleSum(n - 1, u.data(), at), out.v = triangleSum(n - 1, v.data(), at);
  if (order == Order::First || n == 1) return out;
  out.uu = triangleSum(n - 2, derivativeNet(n - 1, u.data(), Towards::U).data(), at);
  out.uv = triangleSum(n - 2, derivativeNet(n - 1, u.data(), Towards::V).data(), at);
  out.vv = triangleSum(n - 2, derivativeNet(n - 1, v.data(), Towards::V).data(), at);
  return out;
}
template HomogeneousJet triangleJet(int, const glm::dvec4*, const DomainPoint&, Order);
template SurfaceJet triangleJet(int, const glm::dvec3*, const DomainPoint&, Order);

HomogeneousJet homogeneousJet(const PatchSet& set, const Patch& patch, const DomainPoint& at, Order order) {
  const glm::dvec4* points = set.points.data() + patch.firstPoint;
  return patch.domain == Domain::Rectangle ? rectangleJet(patch, points, at, order)
                                           : triangleJet(patch.degreeU, points, at, order);
}

SurfaceJet project(const HomogeneousJet& jet) {
  using Point = glm::dvec3;
  const double w = jet.p.w;
  SurfaceJet out;
  out.p = Point(jet.p) / w;
  out.u = (Point(jet.u) - jet.u.w * out.p) / w;
  out.v = (Point(jet.v) - jet.v.w * out.p) / w;
  out.uu = (Point(jet.uu) - 2.0 * jet.u.w * out.u - jet.uu.w * out.p) / w;
  out.vv = (Point(jet.vv) - 2.0 * jet.v.w * out.v - jet.vv.w * out.p) / w;
  out.uv = (Point(jet.uv) - jet.u.w * out.v - jet.v.w * out.u - jet.uv.w * out.p) / w;
  return out;
}

SurfaceJet evaluate(const PatchSet& set, const Patch& patch, const DomainPoint& at, Order order) {
  return project(homogeneousJet(set, patch, at, order));
}

double controlDiagonal(const PatchSet& set, const Patch& patch) {
  glm::dvec3 low(1e300), high(-1e300);
  for (int i = 0; i < patch.points(); ++i) {
    const glm::dvec4& point = set.points[patch.firstPoint + static_cast<uint32_t>(i)];
    if (point.w == 0.0) continue;
    low = glm::min(low, glm::dvec3(point) / point.w), high = glm::max(high, glm::dvec3(point) / point.w);
  }
  return low.x > high.x ? 0.0 : glm::length(high - low);
}

std::vector<glm::dvec4> sidePoints(const PatchSet& set, const Patch& patch, int side) {
  const glm::dvec4* points = set.points.data() + patch.firstPoint;
  const int m = patch.degreeU, n = patch.degreeV;
  const bool alongV = patch.domain == Domain::Rectangle && side % 2 == 1;
  std::vector<glm::dvec4> out;
  for (int i = 0; i <= (alongV ? n : m); ++i) {
    int index = 0;
    if (patch.domain == Domain::Rectangle) {
      const std::array<int, 4> bySide = {i, m + (m + 1) * i, m - i + (m + 1) * n, (m + 1) * (n - i)};
      index = bySide[static_cast<size_t>(side)];
    } else {
      const std::array<int, 3> bySide = {triangleIndex(m, m - i, 0), triangleIndex(m, 0, i),
                                         triangleIndex(m, i, m - i)};
      index = bySide[static_cast<size_t>(side)];
    }
    out.push_back(points[index]);
  }
  return out;
}

bool isCollapsed(const PatchSet& set, const Patch& patch, int side) {
  constexpr double kRounding = 1e-13;
  const std::vector<glm::dvec4> points = sidePoints(set, patch, side);
  const glm::dvec4& first = points[0];
  return std::all_of(points.begin(), points.end(), [&](const glm::dvec4& p) {
    if (p.w == 0.0 || first.w == 0.0) return p == first;
    const glm::dvec3 a = glm::dvec3(first) / first.w, b = glm::dvec3(p) / p.w;
    return glm::length(a - b) <= kRounding * glm::length(a);
  });
}

}  // namespace limen::surfaces

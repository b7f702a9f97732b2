// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/flatness.h"

#include <algorithm>
#include <cmath>

#include "renderer/surfaces/blossom.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec3;

dvec2 onScreen(const dvec3& p) { return dvec2(p) / p.z; }

double toSegment(dvec2 p, dvec2 a, dvec2 b) {
  const dvec2 d = b - a;
  const double squared = glm::dot(d, d);
  const double t = squared > 0.0 ? std::clamp(glm::dot(p - a, d) / squared, 0.0, 1.0) : 0.0;
  return glm::length(p - a - t * d);
}

double toLine(dvec2 p, dvec2 a, dvec2 b) {
  const double length = glm::length(b - a);
  if (!(length > 0.0)) return glm::length(p - a);
  return std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / length;
}

double doubledArea(dvec2 a, dvec2 b, dvec2 c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double toTriangle(dvec2 p, dvec2 a, dvec2 b, dvec2 c) {
  const double s = doubledArea(a, b, c) < 0.0 ? -1.0 : 1.0;
  if (s * doubledArea(a, b, p) >= 0.0 && s * doubledArea(b, c, p) >= 0.0 && s * doubledArea(c, a, p) >= 0.0)
    return 0.0;
  return std::min({toSegment(p, a, b), toSegment(p, b, c), toSegment(p, c, a)});
}

double triangleArea(dvec2 a, dvec2 b, dvec2 c) { return 0.5 * std::abs(doubledArea(a, b, c)); }

dvec3 curveMiddle(std::span<const dvec3> points) {
  const int n = static_cast<int>(points.size()) - 1;
  std::array<dvec3, kMaxDegree + 1> out;
  curvePart(n, points.data(), 1, 0.5, 0.5, out.data(), 1);
  return out[0];
}

double extentOf(std::span<const dvec3> points) {
  dvec2 low(1e300), high(-1e300);
  for (const dvec3& p : points) low = glm::min(low, onScreen(p)), high = glm::max(high, onScreen(p));
  return glm::length(high - low);
}

/// Largest second difference along points `stride` apart, as a bound on the deviation of degree n.
double secondDifference(std::span<const dvec3> points, size_t first, size_t stride, int n) {
  double most = 0.0;
  for (size_t i = 0; i + 2 <= static_cast<size_t>(n); ++i) {
    const dvec2 d = onScreen(points[first + i * stride]) - 2.0 * onScreen(points[first + (i + 1) * stride]) +
                    onScreen(points[first + (i + 2) * stride]);
    most = std::max(most, glm::length(d));
  }
  return n * (n - 1) / 8.0 * most;
}

}  // namespace

double curveFlatness(Flatness kind, std::span<const dvec3> points) {
  const int n = static_cast<int>(points.size()) - 1;
  const dvec2 a = onScreen(points.front()), b = onScreen(points.back());
  double most = 0.0, length = 0.0;
  switch (kind) {
    case Flatness::Midpoint:
      return toSegment(onScreen(curveMiddle(points)), a, b);
    case Flatness::ParameterMidpoint:
      return glm::length(onScreen(curveMiddle(points)) - 0.5 * (a + b));
    case Flatness::Differences:
      return secondDifference(points, 0, 1, n);
    case Flatness::Extent:
      return extentOf(points);
    case Flatness::Length:
      for (size_t i = 1; i < points.size(); ++i)
        length += glm::length(onScreen(points[i]) - onScreen(points[i - 1]));
      return length - glm::length(b - a);
    case Flatness::Control:
    case Flatness::Line:
    case Flatness::Corresponding:
      break;
  }
  for (size_t i = 1; i + 1 < points.size(); ++i) {
    const dvec2 p = onScreen(points[i]);
    most = std::max(most, kind == Flatness::Control ? toSegment(p, a, b)
                          : kind == Flatness::Line  ? toLine(p, a, b)
                                                    : glm::length(p - glm::mix(a, b, double(i) / n)));
  }
  return most;
}

double rectangleFlatness(Flatness kind, int degreeU, int degreeV, std::span<const dvec3> points) {
  const auto at = [&](int i, int j) { return onScreen(points[static_cast<size_t>(i + (degreeU + 1) * j)]); };
  const dvec2 a = at(0, 0), b = at(degreeU, 0), c = at(degreeU, degreeV), d = at(0, degreeV);
  double most = 0.0;
  if (kind == Flatness::Extent) return extentOf(points);
  if (kind == Flatness::Midpoint || kind == Flatness::ParameterMidpoint) {
    std::array<dvec3, kMostPoints> middle;
    rectanglePart(degreeU, degreeV, points.data(), {dvec2(0.5), dvec2(0.5)}, middle.data());
    const dvec2 p = onScreen(middle[0]);
    return kind == Flatness::Midpoint ? std::min(toTriangle(p, a, b, c), toTriangle(p, a, c, d))
                                      : glm::length(p - 0.25 * (a + b + c + d));
  }
  if (kind == Flatness::Length) {
    double net = 0.0;
    for (int j = 0; j < degreeV; ++j)
      for (int i = 0; i < degreeU; ++i)
        net += triangleArea(at(i, j), at(i + 1, j), at(i + 1, j + 1)) +
               triangleArea(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    const double side =
        std::max({glm::length(b - a), glm::length(c - b), glm::length(d - c), glm::length(a - d)});
    const double extra = std::abs(net - triangleArea(a, b, c) - triangleArea(a, c, d));
    return side > 0.0 ? extra / side : std::sqrt(extra);
  }
  for (int j = 0; j <= degreeV; ++j)
    for (int i = 0; i <= degreeU; ++i) {
      const dvec2 p = at(i, j);
      const double u = double(i) / degreeU, v = double(j) / degreeV;
      if (kind == Flatness::Control)
        most = std::max(most, std::min(toTriangle(p, a, b, c), toTriangle(p, a, c, d)));
      if (kind == Flatness::Corresponding)
        most = std::max(most, glm::length(p - glm::mix(glm::mix(a, b, u), glm::mix(d, c, u), v)));
    }
  if (kind == Flatness::Differences) {
    for (int j = 0; j <= degreeV; ++j)
      most = std::max(most, secondDifference(points, static_cast<size_t>(j * (degreeU + 1)), 1, degreeU));
    for (int i = 0; i <= degreeU; ++i)
      most = std::max(
          most, secondDifference(points, static_cast<size_t>(i), static_cast<size_t>(degreeU + 1), degreeV));
  }
  return most;  // Line: the screen is the plane, and everything is in it
}

double triangleFlatness(Flatness kind, int degree, std::span<const dvec3> points) {
  const auto at = [&](int i, int k) {
    return onScreen(points[static_cast<size_t>(triangleIndex(degree, i, k))]);
  };
  const dvec2 a = at(degree, 0), b = at(0, 0), c = at(0, degree);
  double most = 0.0, net = 0.0;
  if (kind == Flatness::Extent) return extentOf(points);
  if (kind == Flatness::Midpoint || kind == Flatness::ParameterMidpoint) {
    const dvec3 third(1.0 / 3.0);
    std::array<dvec3, kMostTrianglePoints> middle;
    trianglePart(degree, points.data(), {third, third, third}, middle.data());
    const dvec2 p = onScreen(middle[0]);
    return kind == Flatness::Midpoint ? toTriangle(p, a, b, c) : glm::length(p - (a + b + c) / 3.0);
  }
  for (int i = 0; i <= degree; ++i)
    for (int k = 0; i + k <= degree; ++k) {
      const int j = degree - i - k;
      const dvec2 p = at(i, k), flat = (double(i) * a + double(j) * b + double(k) * c) / double(degree);
      if (kind == Flatness::Control) most = std::max(most, toTriangle(p, a, b, c));
      if (kind == Flatness::Corresponding) most = std::max(most, glm::length(p - flat));
      if (i > 0) {  // the net's triangle above, and the one below
        net += triangleArea(p, at(i - 1, k), at(i - 1, k + 1));
        if (j > 0) net += triangleArea(p, at(i - 1, k + 1), at(i, k + 1));
      }
      if (kind == Flatness::Differences && i >= 2) {
        most = std::max(most, glm::length(at(i, k) - 2.0 * at(i - 1, k) + at(i - 2, k)));
        most = std::max(most, glm::length(at(i, k) - 2.0 * at(i - 1, k + 1) + at(i - 2, k + 2)));
      }
      if (kind == Flatness::Differences && j >= 2)
        most = std::max(most, glm::length(at(i, k) - 2.0 * at(i, k + 1) + at(i, k + 2)));
    }
  if (kind == Flatness::Differences) return degree * (degree - 1) / 8.0 * most;
  if (kind == Flatness::Length) {
    const double side = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    const double extra = std::abs(net - triangleArea(a, b, c));
    return side > 0.0 ? extra / side : std::sqrt(extra);
  }
  return most;
}

}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/algebraic.h"

#include <algorithm>
#include <cmath>
#include <vector>

#define LIMEN_REAL double

namespace limen::surfaces {
namespace {
namespace algebra {

using std::sqrt;

struct Interval {
  double low = 0.0, high = 0.0;
};
Interval widened(double low, double high) {
  const double margin = 4e-16 * std::max(std::abs(low), std::abs(high)) + 1e-300;
  return {low - margin, high + margin};
}

double add(double a, double b) { return a + b; }
double sub(double a, double b) { return a - b; }
double mul(double a, double b) { return a * b; }
double sqr(double a) { return a * a; }
double scale(double k, double a) { return k * a; }
double shift(double a, double k) { return a + k; }

Interval add(Interval a, Interval b) { return widened(a.low + b.low, a.high + b.high); }
Interval sub(Interval a, Interval b) { return widened(a.low - b.high, a.high - b.low); }
Interval mul(Interval a, Interval b) {
  const double p[4] = {a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
  return widened(*std::min_element(p, p + 4), *std::max_element(p, p + 4));
}
Interval sqr(Interval a) {
  const double p = a.low * a.low, q = a.high * a.high;
  return a.low <= 0.0 && a.high >= 0.0 ? widened(0.0, std::max(p, q))
                                       : widened(std::min(p, q), std::max(p, q));
}
Interval scale(double k, Interval a) {
  return k >= 0.0 ? widened(k * a.low, k * a.high) : widened(k * a.high, k * a.low);
}
Interval shift(Interval a, double k) { return widened(a.low + k, a.high + k); }

/// Value and derivative along the ray.
struct Sloped {
  Interval value, slope;
};
Sloped add(const Sloped& a, const Sloped& b) { return {add(a.value, b.value), add(a.slope, b.slope)}; }
Sloped sub(const Sloped& a, const Sloped& b) { return {sub(a.value, b.value), sub(a.slope, b.slope)}; }
Sloped mul(const Sloped& a, const Sloped& b) {
  return {mul(a.value, b.value), add(mul(a.value, b.slope), mul(a.slope, b.value))};
}
Sloped sqr(const Sloped& a) { return {sqr(a.value), scale(2.0, mul(a.value, a.slope))}; }
Sloped scale(double k, const Sloped& a) { return {scale(k, a.value), scale(k, a.slope)}; }
Sloped shift(const Sloped& a, double k) { return {shift(a.value, k), a.slope}; }

LIMEN_ALGEBRAIC(double)
LIMEN_ALGEBRAIC(Sloped)

template <class Number>
Number valueAt(Algebraic surface, Number x, Number y, Number z) {
  switch (surface) {
    case Algebraic::Sphere:
      return sphereValue(x, y, z);
    case Algebraic::Hyperboloid:
      return hyperboloidValue(x, y, z);
    case Algebraic::Torus:
      return torusValue(x, y, z);
    case Algebraic::Goursat:
      return goursatValue(x, y, z);
    case Algebraic::Heart:
      return heartValue(x, y, z);
    case Algebraic::BarthDecic:
      break;
  }
  return barthDecicValue(x, y, z);
}

Sloped enclosure(Algebraic surface, const Ray& ray, Interval t) {
  const auto coordinate = [&](int axis) {
    const double d = ray.direction[axis];
    return Sloped{shift(scale(d, t), ray.origin[axis]), {d, d}};
  };
  return valueAt(surface, coordinate(0), coordinate(1), coordinate(2));
}

}  // namespace algebra
}  // namespace

int degreeOf(Algebraic surface) {
  switch (surface) {
    case Algebraic::Sphere:
    case Algebraic::Hyperboloid:
      return 2;
    case Algebraic::Torus:
    case Algebraic::Goursat:
      return 4;
    case Algebraic::Heart:
      return 6;
    case Algebraic::BarthDecic:
      break;
  }
  return 10;
}

double radiusOf(Algebraic surface) {
  switch (surface) {
    case Algebraic::Sphere:
      return 1.05;
    case Algebraic::Torus:
      return 3.05;
    case Algebraic::Goursat:
      return 2.8;  // 1 + sqrt(1 + 1 / 3) is its largest squared coordinate
    case Algebraic::Heart:
      return 1.5;
    case Algebraic::Hyperboloid:
    case Algebraic::BarthDecic:
      break;
  }
  return 2.0;
}

double valueOf(Algebraic surface, const glm::dvec3& at) {
  return algebra::valueAt(surface, at.x, at.y, at.z);
}

std::optional<double> firstRoot(Algebraic surface, const Ray& ray, double from, double to) {
  using algebra::Interval;
  constexpr double kWidth = 1e-10;
  std::vector<Interval> stack = {{from, to}};
  const auto at = [&](double t) { return valueOf(surface, ray.origin + t * ray.direction); };
  while (!stack.empty()) {
    const Interval t = stack.back();
    stack.pop_back();
    const algebra::Sloped f = algebra::enclosure(surface, ray, t);
    if (f.value.low > 0.0 || f.value.high < 0.0) continue;
    if (f.slope.low > 0.0 || f.slope.high < 0.0) {
      // Monotonous: a root if the ends differ.
      double low = t.low, high = t.high;
      const bool rises = f.slope.low > 0.0;
      if ((at(low) > 0.0) == (at(high) > 0.0)) continue;
      while (high - low > 1e-14 * std::max(1.0, high)) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        ((at(middle) > 0.0) == rises ? high : low) = middle;
      }
      return 0.5 * (low + high);
    }
    const double middle = 0.5 * (t.low + t.high);
    if (t.high - t.low < kWidth) return middle;
    stack.push_back({middle, t.high});  // the nearer half first
    stack.push_back({t.low, middle});
  }
  return std::nullopt;
}

}  // namespace limen::surfaces

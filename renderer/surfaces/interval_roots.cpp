// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/surfaces/blossom.h"
#include "renderer/surfaces/interval.h"
#include "renderer/surfaces/ray_roots.h"

namespace limen::surfaces {
namespace {

using glm::dvec2;
using glm::dvec4;

constexpr size_t kSide = kMaxDegree + 1;
/// Coefficients of s^i t^j.
using Polynomial = std::array<std::array<Interval, kSide>, kSide>;

double binomial(int n, int k) {
  double out = 1.0;
  for (int i = 1; i <= k; ++i) out = out * (n - k + i) / i;
  return out;
}

/// A box of the domain.
struct Box {
  dvec2 low{0.0}, high{1.0};
  int depth = 0;
};

constexpr int kMostBoxDepth = 100;
/// More boxes than a ray that crosses a patch needs: it lies within the surface.
constexpr int64_t kMostBoxes = 100000;

class IntervalSearch {
 public:
  IntervalSearch(const PatchOnRay& patch, double tolerance, RootCounts& counts)
      : patch_(patch), counts_(counts), m_(patch.degreeU) {
    triangle_ = patch.domain == Domain::Triangle;
    n_ = triangle_ ? m_ : patch.degreeV;
    double least = 1e300;
    for (const dvec4& p : patch.points) least = std::min(least, p.w);
    tolerance_ = tolerance * least;
    x_ = powersOf(0), y_ = powersOf(1);
  }

  std::vector<RayRoot> run() {
    // A little more than the domain, so that roots on its sides can be proven like others.
    constexpr double kBeyond = 1e-7;
    std::vector<Box> stack = {{dvec2(-kBeyond), dvec2(1.0 + kBeyond), 0}};
    int64_t looked = 0;
    while (!stack.empty()) {
      const Box box = stack.back();
      stack.pop_back();
      follow(box, ++looked > kMostBoxes, stack);
    }
    std::sort(roots_.begin(), roots_.end(), [](const RayRoot& a, const RayRoot& b) { return a.t < b.t; });
    return roots_;
  }

 private:
  /// Control points' x or y as a polynomial in the domain's coordinates, by differences. The ray's own
  /// coordinates round as well: control points are taken as intervals.
  Polynomial powersOf(int axis) const {
    double largest = 0.0;
    for (const dvec4& p : patch_.points)
      largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * largest;
    Polynomial d{};
    for (int i = 0; i <= m_; ++i)
      for (int j = 0; j <= (triangle_ ? m_ - i : n_); ++j) {
        const int index = triangle_ ? triangleIndex(m_, i, m_ - i - j) : i + (m_ + 1) * j;
        d[size_t(i)][size_t(j)] = Interval::around(patch_.points[size_t(index)][axis], rounding);
      }
    for (int level = 1; level <= m_; ++level)
      for (int i = m_; i >= level; --i)
        for (int j = 0; j <= (triangle_ ? m_ - i : n_); ++j)
          d[size_t(i)][size_t(j)] = d[size_t(i)][size_t(j)] - d[size_t(i - 1)][size_t(j)];
    for (int i = 0; i <= m_; ++i) {
      const int most = triangle_ ? m_ - i : n_;
      for (int level = 1; level <= most; ++level)
        for (int j = most; j >= level; --j)
          d[size_t(i)][size_t(j)] = d[size_t(i)][size_t(j)] - d[size_t(i)][size_t(j - 1)];
      for (int j = 0; j <= most; ++j)
        d[size_t(i)][size_t(j)] =
            d[size_t(i)][size_t(j)] * (binomial(m_, i) * (triangle_ ? binomial(m_ - i, j) : binomial(n_, j)));
    }
    return d;
  }

  /// In coordinates that run from -1 to 1 over the box.
  Polynomial onBox(Polynomial p, dvec2 middle, dvec2 half) const {
    const auto shift = [](int n, auto at, double by, double scale) {
      for (int level = 0; level < n; ++level)
        for (int i = n - 1; i >= level; --i) at(i) = at(i) + at(i + 1) * by;
      for (int i = 1; i <= n; ++i)
        for (int power = 0; power < i; ++power) at(i) = at(i) * scale;
    };
    for (int j = 0; j <= n_; ++j)
      shift(
          triangle_ ? m_ - j : m_, [&](int i) -> Interval& { return p[size_t(i)][size_t(j)]; }, middle.x,
          half.x);
    for (int i = 0; i <= m_; ++i)
      shift(
          triangle_ ? m_ - i : n_, [&](int j) -> Interval& { return p[size_t(i)][size_t(j)]; }, middle.y,
          half.y);
    return p;
  }

  /// Sum of the coefficients' sizes without the constant one and, if not `linear`, without those of s and t.
  double spread(const Polynomial& p, bool linear) const {
    double sum = 0.0;
    for (int i = 0; i <= m_; ++i)
      for (int j = 0; j <= (triangle_ ? m_ - i : n_); ++j)
        if (i + j >= (linear ? 1 : 2)) sum += p[size_t(i)][size_t(j)].size();
    return sum * (1.0 + 1e-13);
  }

  bool isOutside(const Box& box) const {
    if (box.low.x > 1.0 || box.low.y > 1.0 || box.high.x < 0.0 || box.high.y < 0.0) return true;
    return triangle_ && box.low.x + box.low.y > 1.0 + 1e-15;
  }

  void follow(Box box, bool enough, std::vector<Box>& stack) {
    for (bool proven = false;;) {
      ++counts_.steps;
      if (isOutside(box)) return;
      const dvec2 middle = 0.5 * (box.low + box.high);
      // Middle and half round: the box that is looked at is a trifle larger.
      const dvec2 half = glm::max(box.high - middle, middle - box.low) * (1.0 + 1e-15) + 1e-300;
      const Polynomial x = onBox(x_, middle, half), y = onBox(y_, middle, half);
      const double alongX = spread(x, true), alongY = spread(y, true);
      if (!(Interval::widened(x[0][0].low - alongX, x[0][0].high + alongX).contains(0.0) &&
            Interval::widened(y[0][0].low - alongY, y[0][0].high + alongY).contains(0.0)))
        return;  // proven: no root
      Box next = box;
      bool provenHere = false;
      if (!contract(x, y, middle, half, next, provenHere)) return;
      proven |= provenHere;
      const dvec2 was = box.high - box.low, left = next.high - next.low;
      const bool shrinks = left.x * left.y <= 0.5 * was.x * was.y;
      if (proven) {
        if (!shrinks || std::max(left.x, left.y) < 1e-14) {
          report(0.5 * (next.low + next.high), true);
          return;
        }
      } else if (std::hypot(x[0][0].size() + alongX, y[0][0].size() + alongY) <= tolerance_ || enough ||
                 box.depth >= kMostBoxDepth) {
        report(middle, false);
        return;
      }
      next.depth = box.depth + 1;
      if (shrinks) {
        box = next;
        continue;
      }
      ++counts_.splits;
      // Across the direction along which the ray's distances change most. Halves overlap, so that a root
      // where they meet can be proven.
      const double alongS = x[1][0].size() + y[1][0].size() + x[2][0].size() + y[2][0].size(),
                   alongT = x[0][1].size() + y[0][1].size() + x[0][2].size() + y[0][2].size();
      const int axis = alongS >= alongT ? 0 : 1;
      Box other = next;
      const double cut = 0.5 * (next.low[axis] + next.high[axis]), overlap = 1e-3 * left[axis];
      next.high[axis] = cut + overlap, other.low[axis] = cut - overlap;
      stack.push_back(other);
      box = next;
    }
  }

  /// By the linear parts' inverse: roots lie where s = -p and t = -q, less what is not linear. False if there
  /// is none; `proven` if that maps the box into itself, so that it has a root, and contracts, so that it has
  /// one only.
  bool contract(const Polynomial& x, const Polynomial& y, dvec2 middle, dvec2 half, Box& box,
                bool& proven) const {
    const double a = x[1][0].middle(), b = x[0][1].middle(), c = y[1][0].middle(), d = y[0][1].middle();
    const double det = a * d - b * c;
    const double inverse[2][2] = {{d / det, -b / det}, {-c / det, a / det}};
    proven = true;
    for (int axis = 0; axis < 2; ++axis) {
      const double fromX = inverse[axis][0], fromY = inverse[axis][1];
      if (!std::isfinite(fromX) || !std::isfinite(fromY)) {
        proven = false;
        return true;
      }
      double rest = 0.0, slopes = 0.0;  // of s + p00 + rest, or t + p00 + rest
      Interval constant;
      for (int i = 0; i <= m_; ++i)
        for (int j = 0; j <= (triangle_ ? m_ - i : n_); ++j) {
          Interval one = x[size_t(i)][size_t(j)] * fromX + y[size_t(i)][size_t(j)] * fromY;
          if (i + j == 0) {
            constant = one;
            continue;
          }
          if (i == 1 - axis && j == axis) one = one - Interval{1.0, 1.0};
          rest += one.size(), slopes += (i + j) * one.size();
        }
      rest *= 1.0 + 1e-13;
      const Interval found = Interval::widened(-constant.high - rest, -constant.low + rest);
      if (!(found.low > -1.0 && found.high < 1.0 && slopes < 0.5)) proven = false;
      if (found.low > 1.0 || found.high < -1.0) return false;
      const Interval low = Interval::around(middle[axis]) + Interval::around(half[axis]) * found.low,
                     high = Interval::around(middle[axis]) + Interval::around(half[axis]) * found.high;
      box.low[axis] = std::max(box.low[axis], low.low), box.high[axis] = std::min(box.high[axis], high.high);
      if (box.low[axis] > box.high[axis]) return false;
    }
    return true;
  }

  dvec4 pointAt(dvec2 at) const {
    std::array<dvec4, kMostPoints> points;
    if (triangle_) {
      const glm::dvec3 corner(at.x, at.y, 1.0 - at.x - at.y);
      trianglePart(m_, patch_.points.data(), {corner, corner, corner}, points.data());
    } else {
      rectanglePart(m_, n_, patch_.points.data(), {at, at}, points.data());
    }
    return points[0];
  }

  void report(dvec2 at, bool proven) {
    // Of a proven root the place is known to more digits than these.
    constexpr double kRounding = 1e-12;
    if (proven && isOutside({at - kRounding, at + kRounding, 0})) return;
    at = glm::clamp(at, dvec2(0.0), dvec2(1.0));
    if (triangle_ && at.x + at.y > 1.0) at -= 0.5 * (at.x + at.y - 1.0);
    const dvec4 p = pointAt(at);
    const double t = p.z / p.w;
    if (!(t > 0.0)) return;
    for (const RayRoot& other : roots_) {
      const bool same = std::abs(other.at.u - at.x) + std::abs(other.at.v - at.y) < 1e-9;
      // In space: where the surface touches the ray, many places lie within the tolerance.
      if (same || (!proven && std::abs(other.t - t) <= 50.0 * tolerance_)) {
        ++counts_.duplicates;
        return;
      }
    }
    counts_.unproven += !proven;
    roots_.push_back({t, domainPoint(patch_.domain, at.x, at.y)});
  }

  const PatchOnRay& patch_;
  RootCounts& counts_;
  int m_, n_ = 0;
  bool triangle_ = false;
  double tolerance_ = 0.0;
  Polynomial x_, y_;
  std::vector<RayRoot> roots_;
};

}  // namespace

std::vector<RayRoot> intervalRoots(const PatchOnRay& patch, double tolerance, RootCounts* counts) {
  RootCounts unused;
  return IntervalSearch(patch, tolerance, counts ? *counts : unused).run();
}

}  // namespace limen::surfaces

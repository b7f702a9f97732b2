// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/factors.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace limen::surfaces {
namespace {

using glm::dvec3;
using glm::dvec4;
using Random = std::mt19937;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
dvec3 anyPoint(Random& random) {
  return {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
}

// Repeated interpolation: no Bernstein polynomials.
dvec4 deCasteljau(std::vector<dvec4> points, double t) {
  for (size_t n = points.size(); n > 1; --n)
    for (size_t i = 0; i + 1 < n; ++i) points[i] = (1.0 - t) * points[i] + t * points[i + 1];
  return points[0];
}
dvec4 rectanglePoint(const PatchSet& set, const Patch& patch, glm::dvec2 at) {
  std::vector<dvec4> rows;
  for (int j = 0; j <= patch.degreeV; ++j) {
    const auto first = set.points.begin() + patch.firstPoint + j * (patch.degreeU + 1);
    rows.push_back(deCasteljau({first, first + patch.degreeU + 1}, at.x));
  }
  return deCasteljau(rows, at.y);
}
dvec4 trianglePoint(const PatchSet& set, const Patch& patch, glm::dvec2 at) {
  std::vector<dvec4> b(set.points.begin() + patch.firstPoint,
                       set.points.begin() + patch.firstPoint + patch.points());
  const double w = 1.0 - at.x - at.y;
  const auto index = [](int n, int i, int k) { return size_t((n - i) * (n - i + 1) / 2 + k); };
  for (int n = patch.degreeU - 1; n >= 0; --n) {
    std::vector<dvec4> next(size_t((n + 1) * (n + 2) / 2));
    for (int i = 0; i <= n; ++i)
      for (int k = 0; i + k <= n; ++k)
        next[index(n, i, k)] =
            at.x * b[index(n + 1, i + 1, k)] + at.y * b[index(n + 1, i, k)] + w * b[index(n + 1, i, k + 1)];
    b = next;
  }
  return b[0];
}
dvec3 projected(dvec4 p) { return dvec3(p) / p.w; }

/// Which point of a triangle is compared with the surface at parameters a, b, c between its corners.
enum class Compare { EqualParameters, EqualHomogeneous };

/// Largest distance between the tessellation and the surface.
double deviation(const PatchSet& set, const Patch& patch, const PatternPlan& plan,
                 Compare compare = Compare::EqualParameters) {
  const auto surface = [&](glm::dvec2 at) {
    return patch.domain == Domain::Rectangle ? rectanglePoint(set, patch, at) : trianglePoint(set, patch, at);
  };
  std::vector<glm::dvec2> at;
  std::vector<dvec4> points;
  for (int slot = 0; slot < plan.vertices; ++slot) {
    at.push_back(parametersOf(plan, slot));
    points.push_back(surface(at.back()));
    if (compare == Compare::EqualParameters) points.back() /= points.back().w;
  }
  double most = 0.0;
  constexpr int kSteps = 8;
  for (const glm::uvec3& t : stripTriangles(patternIndices(plan)))
    for (int i = 0; i <= kSteps; ++i)
      for (int j = 0; i + j <= kSteps; ++j) {
        const double a = double(i) / kSteps, b = double(j) / kSteps, c = 1.0 - a - b;
        most = std::max(most, glm::length(projected(surface(a * at[t.x] + b * at[t.y] + c * at[t.z])) -
                                          projected(a * points[t.x] + b * points[t.y] + c * points[t.z])));
      }
  return most;
}

struct One {
  PatchSet set;
  const Patch& patch() const { return set.patches[0]; }
};

/// A slightly bent sheet or a random tangle; `weights`: ratio of the largest to the smallest.
One randomRectangle(Random& random, int m, int n, double weights) {
  One out;
  Patch patch;
  patch.degreeU = uint8_t(m), patch.degreeV = uint8_t(n);
  const double bend = uniform(random, 0.0, 1.0);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i) {
      const dvec3 p = dvec3(double(i) / m, double(j) / n, 0.0) + bend * anyPoint(random);
      const double w = std::exp(uniform(random, 0.0, std::log(weights)));
      out.set.points.emplace_back(w * p, w);
    }
  out.set.patches.push_back(patch);
  return out;
}

One randomTriangle(Random& random, int n) {
  One out;
  Patch patch;
  patch.domain = Domain::Triangle;
  patch.degreeU = patch.degreeV = uint8_t(n);
  const double bend = uniform(random, 0.0, 1.0);
  for (int r = 0; r <= n; ++r)
    for (int k = 0; k <= r; ++k)
      out.set.points.emplace_back(dvec3(n - r, r - k, 0.0) / double(n) + bend * anyPoint(random), 1.0);
  out.set.patches.push_back(patch);
  return out;
}

constexpr std::array<FactorRule, 3> kRules = {FactorRule::Filip, FactorRule::AbiEzziShirman,
                                              FactorRule::Guthe};

// The bound of rational patches holds between a point of the surface and the point of the triangle with the
// same homogeneous weights, so for the distance from the surface to the triangle.
TEST(Factors, RectanglesDeviateByLessThanTheToleranceUnderEveryRule) {
  Random random(1);
  double closest[3] = {};
  int checked = 0;
  for (int i = 0; i < 700; ++i) {
    const int m = 1 + i % 5, n = 1 + i / 5 % 5;
    const double weights = i % 2 ? std::pow(10.0, uniform(random, 0.0, 1.5)) : 1.0;
    const One one = randomRectangle(random, m, n, weights);
    const double eps = std::pow(10.0, uniform(random, -2.5, 0.0));
    for (const FactorRule rule : kRules) {
      const dvec2 segments = segmentsOf(derivativeBounds(one.set, one.patch(), eps), eps, rule);
      if (segments.x > 24 || segments.y > 24) continue;
      const int mu = wholeFactor(segments.x, 64), mv = wholeFactor(segments.y, 64);
      const double found = deviation(one.set, one.patch(), patternOf(Domain::Rectangle, {mu, mv, mu, mv}),
                                     Compare::EqualHomogeneous);
      ASSERT_LE(found, eps * (1 + 1e-9))
          << toText(rule) << " degree " << m << " x " << n << ": " << mu << " x " << mv;
      closest[size_t(rule)] = std::max(closest[size_t(rule)], found / eps);
      ++checked;
    }
  }
  EXPECT_GT(checked, 1000);
  // A bound that were met by far would say that the tolerance is taken for another one.
  for (const double share : closest) EXPECT_GT(share, 0.5);
}

// A triangle of any shape deviates by at most (uu a^2 + 2 uv a b + vv b^2) / 8 if its parameters span a x b:
// the variance of a distribution on an interval of length a is at most a^2 / 4. With the corner fix no
// triangle of a transition spans more than those of the core.
TEST(Factors, FinerSidesKeepTheBoundWithTheCornerFix) {
  Random random(2);
  std::uniform_int_distribution<int> more(0, 9);
  for (int i = 0; i < 600; ++i) {
    const One one = randomRectangle(random, 3, 3, i % 2 ? 5.0 : 1.0);
    const double eps = std::pow(10.0, uniform(random, -1.7, 0.0));
    const dvec2 segments =
        segmentsOf(derivativeBounds(one.set, one.patch(), eps), eps, FactorRule::AbiEzziShirman);
    if (segments.x > 24 || segments.y > 24) continue;
    const int mu = wholeFactor(segments.x, 64), mv = wholeFactor(segments.y, 64);
    const Factors factors{mu + more(random) * (i % 3 == 0), mv + more(random),
                          mu + more(random) * (i % 3 != 0), mv + more(random)};
    const PatternPlan plan = patternOf(Domain::Rectangle, factors);
    ASSERT_LE(deviation(one.set, one.patch(), plan, Compare::EqualHomogeneous), eps * (1 + 1e-9));
  }
}

TEST(Factors, NearlyStraightDirectionsTakeOneSegmentAndNoMoreAcross) {
  // du = 1 leaves 8 eps - 1e-6 for 2 dv + dv^2, hence about 1 / dv = 250.5 segments, as with uu = 0.
  const double eps8 = 8e-3;
  for (const FactorRule rule : {FactorRule::Filip, FactorRule::AbiEzziShirman}) {
    const dvec2 exact = segmentsFor(0.0, 1.0, 1.0, eps8, int(rule)),
                near = segmentsFor(1e-6, 1.0, 1.0, eps8, int(rule)),
                turned = segmentsFor(1.0, 1.0, 1e-6, eps8, int(rule));
    EXPECT_EQ(std::ceil(exact.x), 1.0);
    EXPECT_EQ(std::ceil(exact.y), 251.0);
    EXPECT_EQ(std::ceil(near.x), 1.0);
    EXPECT_EQ(std::ceil(near.y), 251.0);
    EXPECT_EQ(std::ceil(turned.x), 251.0);
    EXPECT_EQ(std::ceil(turned.y), 1.0);
  }
  const dvec2 guthe = segmentsFor(1e-6, 1.0, 1.0, eps8, int(FactorRule::Guthe));
  EXPECT_EQ(std::ceil(guthe.x), 16.0);
  EXPECT_EQ(std::ceil(guthe.y), 23.0);
}

TEST(Factors, EveryRuleSatisfiesTheConditionForAnyBounds) {
  Random random(3);
  for (int i = 0; i < 200000; ++i) {
    const auto size = [&] { return i % 7 == 0 ? 0.0 : std::pow(10.0, uniform(random, -12, 6)); };
    const double uu = uniform(random, 0, 1) < 0.2 ? 0.0 : size(),
                 uv = uniform(random, 0, 1) < 0.2 ? 0.0 : size(),
                 vv = uniform(random, 0, 1) < 0.2 ? 0.0 : size(),
                 eps8 = std::pow(10.0, uniform(random, -6, 3));
    double area[3];
    for (const FactorRule rule : kRules) {
      const dvec2 m = segmentsFor(uu, uv, vv, eps8, int(rule));
      ASSERT_TRUE(m.x >= 1.0 && m.y >= 1.0 && std::isfinite(m.x) && std::isfinite(m.y));
      ASSERT_LE(uu / m.x / m.x + 2 * uv / m.x / m.y + vv / m.y / m.y, eps8 * (1 + 1e-9))
          << toText(rule) << ": " << uu << " " << uv << " " << vv << " " << eps8;
      area[size_t(rule)] = m.x * m.y;
    }
    // Abi-Ezzi and Shirman's is the smallest product of segments, where neither is held at 1.
    const dvec2 m = segmentsFor(uu, uv, vv, eps8, int(FactorRule::AbiEzziShirman));
    if (m.x > 1.0 && m.y > 1.0) {
      ASSERT_LE(area[1], area[0] * (1 + 1e-9));
    }
  }
}

// A twisted strip, straight along u: one segment across would take 1,333 along. With 64 of them, the
// condition holds with 24 across.
TEST(Factors, WhereOneDirectionIsCappedTheOtherTakesMore) {
  const double uv = 6.0, vv = 18.0, eps8 = 9e-3, most = 64;
  EXPECT_GT(segmentsFor(0.0, uv, vv, eps8, kRuleAbiEzziShirman).y, 1000.0);
  const dvec2 m = segmentsWithin(0.0, uv, vv, eps8, kRuleAbiEzziShirman, most);
  EXPECT_EQ(m.y, most);
  // 2 uv du / 64 = 9e-3 - 18 / 64^2.
  EXPECT_NEAR(m.x, 2 * uv / most / (eps8 - vv / most / most), 1e-9);
  EXPECT_LE(m.x, most);

  Random random(9);
  int helped = 0;
  for (int i = 0; i < 100000; ++i) {
    const auto size = [&] { return i % 3 == 0 ? 0.0 : std::pow(10.0, uniform(random, -6, 3)); };
    const double a = size(), b = std::pow(10.0, uniform(random, -3, 3)), c = size();
    const double e = std::pow(10.0, uniform(random, -4, 1));
    for (const FactorRule rule : kRules) {
      const dvec2 free = segmentsFor(a, b, c, e, int(rule)),
                  held = segmentsWithin(a, b, c, e, int(rule), most);
      if (free.x <= most && free.y <= most) {
        ASSERT_EQ(free, held);
      } else if (held.x <= most && held.y <= most) {
        ASSERT_LE(a / held.x / held.x + 2 * b / held.x / held.y + c / held.y / held.y, e * (1 + 1e-9));
        ++helped;
      } else {
        // Both at their most are too few.
        ASSERT_GT(a / most / most + 2 * b / most / most + c / most / most, e * (1 - 1e-9));
      }
    }
  }
  EXPECT_GT(helped, 1000);
}

TEST(Factors, RecentringNeverAsksForMoreAndIgnoresWhereThePatchLies) {
  Random random(4);
  for (int i = 0; i < 300; ++i) {
    One one = randomRectangle(random, 3, 3, 10.0);
    const dvec3 move = 100.0 * anyPoint(random);
    One moved = one;
    for (dvec4& p : moved.set.points) p += dvec4(p.w * move, 0.0);
    const DerivativeBounds here = derivativeBounds(one.set, one.patch(), 0.01),
                           there = derivativeBounds(moved.set, moved.patch(), 0.01),
                           far = derivativeBounds(moved.set, moved.patch(), 0.01, false);
    EXPECT_NEAR(here.uu, there.uu, 1e-9 * here.uu);
    EXPECT_NEAR(here.uv, there.uv, 1e-9 * here.uv);
    EXPECT_LT(there.uu, far.uu);
  }
}

TEST(Factors, BezierTrianglesAtTheirLargestFactorKeepTheTolerance) {
  Random random(5);
  int checked = 0;
  for (int i = 0; i < 800; ++i) {
    const One one = randomTriangle(random, 2 + i % 3);
    const double eps = std::pow(10.0, uniform(random, -2.0, 0.0));
    const std::array<double, 3> segments = triangleSegments(one.set, one.patch(), eps);
    const double most = std::max({segments[0], segments[1], segments[2]});
    if (most > 30) continue;
    const int m = wholeFactor(most, 64);
    const double found = deviation(one.set, one.patch(), patternOf(Domain::Triangle, {m, m, m, 1}));
    ASSERT_LE(found, eps * (1 + 1e-9));
    ++checked;
  }
  EXPECT_GT(checked, 300);
}

// z = k |p|^2 over an equilateral triangle with sides of 1: the second derivative along a side is 2 k, the
// mixed one of two sides k, so m^2 = 3 k / (4 eps). A small triangle's middle is 1 / (m sqrt 3) from its
// corners and hence k / (3 m^2) = 4/9 eps from the surface.
TEST(Factors, ParaboloidOverAnEquilateralTriangleDeviatesByFourNinthsOfTheTolerance) {
  const double k = 0.75;
  const dvec3 p[3] = {{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
  // The polar form of |p|^2 at the control points (u u, u v, u w, v v, v w, w w).
  One one;
  Patch patch;
  patch.domain = Domain::Triangle;
  patch.degreeU = patch.degreeV = 2;
  for (const auto& [a, b] : {std::pair(0, 0), {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}})
    one.set.points.emplace_back(0.5 * (p[a] + p[b]) + dvec3(0, 0, k * glm::dot(p[a], p[b])), 1.0);
  one.set.patches.push_back(patch);
  const double eps = 3 * k / 4 / 36.0;  // m = 6
  for (const double segments : triangleSegments(one.set, one.patch(), eps)) EXPECT_NEAR(segments, 6.0, 1e-9);
  // The 9 sample points a side do not hold the middle; the nearest is (3, 3, 2) / 8.
  const double found = deviation(one.set, one.patch(), patternOf(Domain::Triangle, {6, 6, 6, 1}));
  EXPECT_NEAR(found / eps, 4.0 / 9, 0.01);
}

/// A PN triangle (Vlachos et al. 2001) of a random triangle with normals tilted by up to `tilt`.
One randomPnTriangle(Random& random, double tilt) {
  const dvec3 p[3] = {{0, 0, 0}, {1, 0, 0}, {uniform(random, 0.2, 0.8), uniform(random, 0.4, 1.2), 0}};
  dvec3 n[3];
  for (dvec3& normal : n)
    normal = glm::normalize(dvec3(tilt * uniform(random, -1, 1), tilt * uniform(random, -1, 1), 1));
  const auto tangent = [&](int a, int b) {
    return (2.0 * p[a] + p[b] - glm::dot(p[b] - p[a], n[a]) * n[a]) / 3.0;
  };
  // Corners in the order u, v, w; rows of the arrangement of patch_set.h.
  const dvec3 uv = tangent(0, 1), vu = tangent(1, 0), vw = tangent(1, 2), wv = tangent(2, 1),
              wu = tangent(2, 0), uw = tangent(0, 2), e = (uv + vu + vw + wv + wu + uw) / 6.0,
              inner = e + 0.5 * (e - (p[0] + p[1] + p[2]) / 3.0);
  One out;
  Patch patch;
  patch.domain = Domain::Triangle;
  for (const dvec3& point : {p[0], uv, uw, vu, inner, wu, p[1], vw, wv, p[2]})
    out.set.points.emplace_back(point, 1.0);
  out.set.patches.push_back(patch);
  return out;
}

// The thesis calls 9/4 an estimate. How often it fails is a result: reported, and here only told apart from
// the bounds, which must not fail.
TEST(Factors, PnTrianglesKeepTheSafeBoundsAndBreakTheEstimateNowAndThen) {
  Random random(6);
  int checked = 0, broken[3] = {};
  double worst[3] = {};
  for (int i = 0; i < 2000; ++i) {
    const One one = randomPnTriangle(random, uniform(random, 0.05, 1.0));
    const double eps =
        largestTangentDistance(one.set, one.patch()) * std::pow(10.0, uniform(random, -1.2, 0.0));
    if (eps <= 0.0) continue;
    ++checked;
    for (const PnBound bound : {PnBound::Boundary, PnBound::Tied, PnBound::Safe}) {
      const int m = wholeFactor(pnSegments(one.set, one.patch(), eps, bound), 64);
      const double found = deviation(one.set, one.patch(), patternOf(Domain::Triangle, {m, m, m, 1})) / eps;
      if (found > 1.0) ++broken[size_t(bound)];
      worst[size_t(bound)] = std::max(worst[size_t(bound)], found);
    }
  }
  std::printf("of %d: 9/4 broken %d, worst %.3f; 39/4 %d, %.3f; 45/4 %d, %.3f\n", checked, broken[0],
              worst[0], broken[1], worst[1], broken[2], worst[2]);
  RecordProperty("broken_9_4", broken[0]);
  EXPECT_EQ(broken[1], 0);
  EXPECT_EQ(broken[2], 0);
}

TEST(Factors, SizesOfACurve) {
  // c(t) = (0,0) (1,1) (2,0): c' = 2 (1, 1 - 2 t), at most 2 sqrt 2 long.
  const std::vector<dvec3> arch = {{0, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  EXPECT_DOUBLE_EQ(sizeOf(CurveSize::Chord, arch), 2.0);
  EXPECT_DOUBLE_EQ(sizeOf(CurveSize::Rockwood, arch), 2.0 * std::sqrt(2.0));
  EXPECT_DOUBLE_EQ(sizeOf(CurveSize::Kumar, arch), 2.0 * std::sqrt(2.0));
  // Derivatives (2, 0) and (0, 2): no place has both, but a secant may be longer than any one of them.
  const std::vector<dvec3> bend = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}};
  EXPECT_DOUBLE_EQ(sizeOf(CurveSize::Rockwood, bend), 2.0);
  EXPECT_DOUBLE_EQ(sizeOf(CurveSize::Kumar, bend), 2.0 * std::sqrt(2.0));
}

TEST(Factors, ToleranceIsAPixelsShareOfThePictureAtItsDepth) {
  // 100 rows over 2 * tan(45 degrees) * 10 = 20 units: a pixel is 0.2.
  EXPECT_DOUBLE_EQ(objectTolerance(0.5, 10.0, 1.0, 100), 0.1);
  EXPECT_DOUBLE_EQ(objectTolerance(0.5, 10.0, 1.0, 100, std::sqrt(3.0)), 0.05);
}

}  // namespace
}  // namespace limen::surfaces

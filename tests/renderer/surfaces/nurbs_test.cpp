// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/nurbs.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "renderer/scene/curved/nurbs_solids.h"
#include "renderer/surfaces/bezier.h"
#include "renderer/surfaces/neighbours.h"
#include "renderer/surfaces/nurbs_point.h"
#include "tests/renderer/surfaces/bezier_oracle.h"

namespace limen::surfaces {
namespace {

/// Basis function by the recursion of Cox and de Boor (Schwarz 2009, section 6.1.4), 0/0 = 0.
double basis(const std::vector<double>& t, size_t i, int k, double x) {
  if (k == 0) return t[i] <= x && x < t[i + 1] ? 1.0 : 0.0;
  const auto n = static_cast<size_t>(k);
  const double left = t[i + n] - t[i], right = t[i + 1 + n] - t[i + 1];
  return (left > 0.0 ? (x - t[i]) / left * basis(t, i, k - 1, x) : 0.0) +
         (right > 0.0 ? (t[i + 1 + n] - x) / right * basis(t, i + 1, k - 1, x) : 0.0);
}

glm::dvec3 coxDeBoor(const NurbsSurface& s, double u, double v) {
  glm::dvec4 sum(0.0);
  for (int j = 0; j < s.pointsV(); ++j)
    for (int i = 0; i < s.pointsU(); ++i)
      sum += basis(s.knotsU, size_t(i), s.degreeU, u) * basis(s.knotsV, size_t(j), s.degreeV, v) *
             s.points[size_t(i + s.pointsU() * j)];
  return glm::dvec3(sum) / sum.w;
}

std::vector<double> distinct(const std::vector<double>& knots, int degree) {
  const std::set<double> inside(knots.begin() + degree, knots.end() - degree);
  return {inside.begin(), inside.end()};
}

/// Every patch against the basis functions, at points of its span.
void expectSame(const NurbsSurface& surface) {
  const PatchSet set = nurbsPatches(surface);
  const std::vector<double> u = distinct(surface.knotsU, surface.degreeU),
                            v = distinct(surface.knotsV, surface.degreeV);
  ASSERT_EQ(set.patches.size(), (u.size() - 1) * (v.size() - 1));
  for (size_t t = 0; t + 1 < v.size(); ++t)
    for (size_t s = 0; s + 1 < u.size(); ++s)
      for (const double y : {0.0, 0.3, 0.9})
        for (const double x : {0.0, 0.45, 0.8}) {
          const Patch& patch = set.patches[s + (u.size() - 1) * t];
          const glm::dvec3 expected =
              coxDeBoor(surface, u[s] + x * (u[s + 1] - u[s]), v[t] + y * (v[t + 1] - v[t]));
          EXPECT_LT(glm::length(evaluate(set, patch, rectanglePoint(x, y)).p - expected),
                    1e-12 * (1.0 + controlDiagonal(set, patch)))
              << s << ' ' << t;
        }
}

std::vector<double> randomKnots(scene::Random& random, int degree, int points, bool clamped) {
  std::vector<double> knots(size_t(points + degree + 1));
  double at = 0.0;
  for (size_t i = 0; i < knots.size(); ++i) {
    const bool end = i <= size_t(degree) || i >= size_t(points);
    if (!(clamped && end && i != size_t(points)))
      at += random.uniform(0, 1) < 0.3 && degree > 1 && i % 2 ? 0.0 : random.uniform(0.1, 1.0);
    knots[i] = at;
  }
  return knots;
}

/// SC-15: degrees 1 to 5, ends that are clamped and ends that are not, knots repeated here and there.
TEST(Nurbs, PatchesAreThoseOfTheBasisFunctions) {
  scene::Random random(5);
  for (int m = 1; m <= 5; ++m)
    for (int n = 1; n <= 5; ++n)
      for (const bool clamped : {false, true}) {
        NurbsSurface surface;
        surface.degreeU = m, surface.degreeV = n;
        surface.knotsU = randomKnots(random, m, m + 4, clamped);
        surface.knotsV = randomKnots(random, n, n + 3, clamped);
        for (int k = 0; k < surface.pointsU() * surface.pointsV(); ++k)
          surface.points.push_back(oracle::randomPoint(random, 5.0));
        SCOPED_TRACE(testing::Message() << m << ' ' << n << (clamped ? " clamped" : ""));
        expectSame(surface);
      }
}

/// SC-16 and SC-17: at any parameters, the last knot and beyond included.
TEST(NurbsPoint, IsThatOfTheBasisFunctions) {
  scene::Random random(15);
  for (int m = 1; m <= 5; ++m)
    for (int n = 1; n <= 5; ++n) {
      NurbsSurface surface;
      surface.degreeU = m, surface.degreeV = n;
      surface.knotsU = randomKnots(random, m, m + 5, true);
      surface.knotsV = randomKnots(random, n, n + 4, false);
      for (int k = 0; k < surface.pointsU() * surface.pointsV(); ++k)
        surface.points.push_back(oracle::randomPoint(random, 5.0));
      const double low = surface.knotsU[size_t(m)], high = surface.knotsU[size_t(surface.pointsU())],
                   bottom = surface.knotsV[size_t(n)], top = surface.knotsV[size_t(surface.pointsV())];
      std::vector<double> us, vs;
      for (int k = 0; k < 20; ++k)
        us.push_back(random.uniform(low, high)), vs.push_back(random.uniform(bottom, top));
      us.push_back(low), vs.push_back(bottom);
      const std::vector<glm::dvec4> grid = nurbsGrid(surface, us, vs);
      for (size_t j = 0; j < vs.size(); ++j)
        for (size_t i = 0; i < us.size(); ++i) {
          const glm::dvec4 p = nurbsPoint(surface, us[i], vs[j]);
          EXPECT_LT(glm::length(glm::dvec3(p) / p.w - coxDeBoor(surface, us[i], vs[j])), 1e-11);
          EXPECT_EQ(p, grid[i + us.size() * j]);
        }
      // The basis functions are 0 at the last knot; the patches are not.
      const PatchSet set = nurbsPatches(surface);
      const glm::dvec4 last = nurbsPoint(surface, high, top), beyond = nurbsPoint(surface, high + 1.0, top);
      EXPECT_LT(glm::length(glm::dvec3(last) / last.w -
                            evaluate(set, set.patches.back(), rectanglePoint(1.0, 1.0)).p),
                1e-11);
      EXPECT_EQ(last, beyond);
    }
}

TEST(Nurbs, ShippedSurfacesAreThemselves) {
  expectSame(scene::nurbsSheet({0, 0, 0}, 1.0));
  expectSame(scene::nurbsSphere({1, 2, 3}, 0.5));
}

/// Knots 1e-7 apart: a sliver of a patch, no division by nothing.
TEST(Nurbs, KnotsMayNearlyCoincide) {
  NurbsSurface surface = scene::nurbsSheet({0, 0, 0}, 1.0);
  surface.knotsU[6] = surface.knotsU[5] + 1e-7;
  expectSame(surface);
}

/// A sphere of nine by five points: exact, closed where it meets itself.
TEST(Nurbs, SphereIsExactAndClosed) {
  PatchSet set = nurbsPatches(scene::nurbsSphere({0, 0, 0}, 2.0));
  EXPECT_EQ(set.patches.size(), 8U);
  const SideCounts counts = findNeighbours(set);
  EXPECT_EQ(counts.shared, 24U);
  EXPECT_EQ(counts.collapsed, 8U);
  for (const Patch& patch : set.patches)
    EXPECT_NEAR(glm::length(evaluate(set, patch, rectanglePoint(0.3, 0.6)).p), 2.0, 1e-14);
}

TEST(Nurbs, RefusesKnotsThatDoNotFit) {
  NurbsSurface surface = scene::nurbsSheet({0, 0, 0}, 1.0);
  std::swap(surface.knotsU[4], surface.knotsU[5]);
  EXPECT_THROW(nurbsPatches(surface), std::invalid_argument);
  surface = scene::nurbsSheet({0, 0, 0}, 1.0);
  surface.knotsU[4] = surface.knotsU[7] = 0.5;  // four times, in degree 3
  EXPECT_THROW(nurbsPatches(surface), std::invalid_argument);
  surface = scene::nurbsSheet({0, 0, 0}, 1.0);
  surface.points.pop_back();
  EXPECT_THROW(nurbsPatches(surface), std::invalid_argument);
}

}  // namespace
}  // namespace limen::surfaces

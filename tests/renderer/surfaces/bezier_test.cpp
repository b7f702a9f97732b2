// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/bezier.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "renderer/surfaces/bernstein.h"
#include "tests/renderer/surfaces/bezier_oracle.h"

namespace limen::surfaces {
namespace {

using scene::Random;

/// Calls check(set, u, v) with random patches of all degrees and weights and parameters within the domain.
template <class Check>
void forRandomPatches(Domain domain, Check check) {
  Random random(7);
  for (int m = 1; m <= kMaxDegree; ++m)
    for (int n = 1; n <= kMaxDegree; ++n) {
      if (domain == Domain::Triangle && n != m) continue;
      for (const double range : {1.0, 10.0, 1e3})
        for (int sample = 0; sample < 4; ++sample) {
          const PatchSet set = oracle::randomPatch(random, domain, m, n, range);
          double u = random.uniform(0.02, 0.98), v = random.uniform(0.02, 0.98);
          if (domain == Domain::Triangle && u + v > 0.98) u = 1 - u, v = 1 - v;
          SCOPED_TRACE(testing::Message() << "degrees " << m << ", " << n << ", weights to " << range);
          check(set, u, v);
        }
    }
}

double distance(glm::dvec3 a, const oracle::Point3& b) { return double(glm::length(oracle::Point3(a) - b)); }

class EveryDomain : public testing::TestWithParam<Domain> {};
INSTANTIATE_TEST_SUITE_P(Bezier, EveryDomain, testing::Values(Domain::Rectangle, Domain::Triangle),
                         [](const auto& domain) {
                           return domain.param == Domain::Rectangle ? "Rectangle" : "Triangle";
                         });

/// SC-01 to SC-03. All terms are positive multiples of points, so rounding is within a few dozen units in the
/// last place of the diagonal, whatever the weights.
TEST_P(EveryDomain, PositionsAreThoseOfDeCasteljau) {
  forRandomPatches(GetParam(), [](const PatchSet& set, double u, double v) {
    const Patch& patch = set.patches[0];
    const SurfaceJet jet = evaluate(set, patch, domainPoint(patch.domain, u, v));
    EXPECT_LT(distance(jet.p, oracle::position(set, patch, u, v)), 1e-13 * controlDiagonal(set, patch));
  });
}

TEST_P(EveryDomain, DerivativesAreThoseOfFiniteDifferences) {
  forRandomPatches(GetParam(), [](const PatchSet& set, double u, double v) {
    const Patch& patch = set.patches[0];
    const SurfaceJet jet = evaluate(set, patch, domainPoint(patch.domain, u, v));
    using oracle::Point3;
    using oracle::Real;
    const auto at = [&](Real du, Real dv) { return oracle::position(set, patch, u + du, v + dv); };
    const auto alongU = [&](Real du, Real dv) {
      return oracle::derivative([&](Real x) { return at(du + x, dv); }, 1e-4L);
    };
    const auto alongV = [&](Real du, Real dv) {
      return oracle::derivative([&](Real x) { return at(du, dv + x); }, 1e-4L);
    };
    const auto close = [](glm::dvec3 a, const Point3& b) {
      return distance(a, b) < 1e-6 * (1.0 + double(glm::length(b)));
    };
    EXPECT_TRUE(close(jet.u, alongU(0, 0)));
    EXPECT_TRUE(close(jet.v, alongV(0, 0)));
    EXPECT_TRUE(close(jet.uu, oracle::derivative([&](Real x) { return alongU(x, 0); }, 1e-4L)));
    EXPECT_TRUE(close(jet.vv, oracle::derivative([&](Real x) { return alongV(0, x); }, 1e-4L)));
    EXPECT_TRUE(close(jet.uv, oracle::derivative([&](Real x) { return alongU(0, x); }, 1e-4L)));
  });
}

TEST_P(EveryDomain, LowerOrdersGiveTheSameBits) {
  forRandomPatches(GetParam(), [](const PatchSet& set, double u, double v) {
    const DomainPoint at = domainPoint(set.patches[0].domain, u, v);
    const SurfaceJet all = evaluate(set, set.patches[0], at),
                     first = evaluate(set, set.patches[0], at, Order::First),
                     position = evaluate(set, set.patches[0], at, Order::Position);
    EXPECT_TRUE(all.p == first.p && all.p == position.p && all.u == first.u && all.v == first.v);
  });
}

/// Directional derivatives of triangles against control points of the thesis (section 6.1.3) for a cubic: the
/// first derivative along side s is 3 times a difference at the corner where the side begins, the second 6
/// times a second difference.
TEST(BezierTriangle, DirectionalDerivativesAtCornersAreControlDifferences) {
  Random random(3);
  const PatchSet set = oracle::randomPatch(random, Domain::Triangle, 3, 3, 1.0);
  for (int side = 0; side < 3; ++side) {
    const std::vector<glm::dvec4> b = sidePoints(set, set.patches[0], side);
    const SurfaceJet jet = evaluate(set, set.patches[0], sidePoint(Domain::Triangle, side, 0, 1));
    const glm::dvec2 d = kTriangleSides[size_t(side)];
    EXPECT_LT(glm::length(jet.along(d) - glm::dvec3(3.0 * (b[1] - b[0]))), 1e-13);
    EXPECT_LT(glm::length(jet.along(d, d) - glm::dvec3(6.0 * (b[2] - 2.0 * b[1] + b[0]))), 1e-12);
  }
}

TEST(Bernstein, PolynomialsAreAPartitionOfUnityAndMirror) {
  for (int n = 0; n <= kMaxDegree; ++n)
    for (int i = 0; i <= 40; ++i) {
      const double t = i / 40.0, s = (40 - i) / 40.0;
      const Basis a = bernstein(n, t, s), b = bernstein(n, s, t);
      double sum = 0.0;
      for (size_t k = 0; k <= size_t(n); ++k) {
        sum += a[k];
        EXPECT_EQ(a[k], b[size_t(n) - k]);
        EXPECT_GE(a[k], 0.0);
      }
      EXPECT_NEAR(sum, 1.0, 1e-15 * (n + 1));
    }
}

/// All control points in one place: the surface is that place whatever the weights.
TEST_P(EveryDomain, WeightsAloneMoveNothing) {
  Random random(5);
  for (int n = 1; n <= kMaxDegree; ++n) {
    PatchSet set = oracle::randomPatch(random, GetParam(), n, n, 1e3);
    for (glm::dvec4& point : set.points) point = weighted({0.3, -2.0, 7.0}, point.w);
    const SurfaceJet jet = evaluate(set, set.patches[0], domainPoint(GetParam(), 0.3, 0.4));
    EXPECT_LT(glm::length(jet.p - glm::dvec3(0.3, -2.0, 7.0)), 1e-13);
    EXPECT_LT(glm::length(jet.u) + glm::length(jet.v), 1e-10);
  }
}

/// Sides run from corner s to corner s + 1, and the surface on a side is the curve of the side's points.
TEST_P(EveryDomain, SidesAreTheCurvesOfTheirPoints) {
  Random random(11);
  const int sides = sidesOf(GetParam());
  const PatchSet set =
      oracle::randomPatch(random, GetParam(), 4, GetParam() == Domain::Triangle ? 4 : 3, 10.0);
  for (int side = 0; side < sides; ++side) {
    const std::vector<glm::dvec4> points = sidePoints(set, set.patches[0], side);
    EXPECT_EQ(points.back(), sidePoints(set, set.patches[0], (side + 1) % sides).front());
    for (int i = 0; i <= 5; ++i) {
      const oracle::Point4 p =
          oracle::curve({points.begin(), points.end()}, oracle::Real(i) / oracle::Real(5));
      const SurfaceJet jet = evaluate(set, set.patches[0], sidePoint(GetParam(), side, i, 5));
      EXPECT_LT(distance(jet.p, oracle::Point3(p) / p.w), 1e-14);
    }
  }
}

/// SC-05: a rectangle or triangle with the same control points along one of its sides, in either direction,
/// has the same bits there, with any number of segments.
TEST(Bezier, SharedBoundariesAreBitwiseTheSame) {
  Random random(13);
  for (int n = 1; n <= kMaxDegree; ++n) {
    std::vector<glm::dvec4> curve;
    for (int i = 0; i <= n; ++i) curve.push_back(oracle::randomPoint(random, 1e3));
    for (const auto& [domain, other] :
         {std::pair(Domain::Rectangle, Domain::Rectangle), std::pair(Domain::Rectangle, Domain::Triangle),
          std::pair(Domain::Triangle, Domain::Triangle)}) {
      for (int side = 0; side < sidesOf(domain); ++side)
        for (int otherSide = 0; otherSide < sidesOf(other); ++otherSide) {
          PatchSet a = oracle::randomPatch(random, domain, n, n, 1e3),
                   b = oracle::randomPatch(random, other, n, n, 1e3);
          const auto put = [&](PatchSet& set, int s, bool reversed) {
            const std::vector<glm::dvec4> old = sidePoints(set, set.patches[0], s);
            for (glm::dvec4& point : set.points)
              for (int i = 0; i <= n; ++i)
                if (point == old[size_t(i)]) {
                  point = curve[size_t(reversed ? n - i : i)];
                  break;
                }
          };
          put(a, side, false), put(b, otherSide, true);
          for (int m = 1; m <= 64; ++m)
            for (int i = 0; i <= m; ++i) {
              const glm::dvec3 p = evaluate(a, a.patches[0], sidePoint(domain, side, i, m)).p,
                               q = evaluate(b, b.patches[0], sidePoint(other, otherSide, m - i, m)).p;
              ASSERT_EQ(std::memcmp(&p, &q, sizeof p), 0) << "degree " << n << ", sides " << side << ", "
                                                          << otherSide << ", sample " << i << '/' << m;
            }
        }
    }
  }
}

/// A direction (weight 0) between two points: the half circle of radius 1, infinite control point and all.
TEST(Bezier, ControlPointsMayBeDirections) {
  PatchSet set;
  addRectangle(
      set, 2, 1,
      std::array<glm::dvec4, 6>{glm::dvec4(1, 0, 0, 1), glm::dvec4(0, 1, 0, 0), glm::dvec4(-1, 0, 0, 1),
                                glm::dvec4(1, 0, 1, 1), glm::dvec4(0, 1, 0, 0), glm::dvec4(-1, 0, 1, 1)});
  for (int i = 0; i <= 16; ++i) {
    const SurfaceJet jet = evaluate(set, set.patches[0], rectangleGridPoint(i, 16, 1, 3));
    EXPECT_NEAR(glm::length(glm::dvec2(jet.p)), 1.0, 1e-15);
    EXPECT_GE(jet.p.y, 0.0);
  }
  // Directions have no place.
  EXPECT_DOUBLE_EQ(controlDiagonal(set, set.patches[0]), std::sqrt(5.0));
}

}  // namespace
}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/spacing.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "renderer/surfaces/patterns.h"

namespace limen::surfaces {
namespace {

constexpr int kAll[] = {kSpacingInteger,       kSpacingDyadic,  kSpacingFractionalEven,
                        kSpacingFractionalOdd, kSpacingMoreton, kSpacingGeomorph};

int unitsOf(double factor) { return static_cast<int>(factor * kSegmentUnit); }

std::vector<double> lengths(int spacing, double factor) {
  const int units = unitsOf(factor), n = spacedSegments(spacing, units);
  std::vector<double> out;
  for (int i = 0; i < n; ++i)
    out.push_back(spacedPlace(spacing, units, i + 1, n) - spacedPlace(spacing, units, i, n));
  return out;
}

void expectLengths(const std::vector<double>& expected, const std::vector<double>& found) {
  ASSERT_EQ(expected.size(), found.size());
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(expected[i], found[i], 1e-12) << i;
}

/// The example of the thesis, 3.5 -> 7/24, 7/24, 7/24, 3/24, is half of a symmetric division by 7.
TEST(Spacing, HasTheLengthsOfTheExample) {
  const double a = 7.0 / 48, b = 3.0 / 48;
  expectLengths({a, a, a, b, b, a, a, a}, lengths(kSpacingFractionalEven, 7.0));
}

TEST(Spacing, OddNumbersGrowTwoSegmentsBesideTheMiddle) {
  // Half-way between 3 and 5.
  const double old = 0.5 * (1.0 / 3 + 1.0 / 5), added = 0.1;
  expectLengths({old, added, old, added, old}, lengths(kSpacingFractionalOdd, 4.0));
}

TEST(Spacing, MoretonsSegmentsAreOneOverTheFactorButInTheMiddle) {
  const double a = 1.0 / 4.5, b = 0.5 - 2.0 / 4.5;
  expectLengths({a, a, b, b, a, a}, lengths(kSpacingMoreton, 4.5));
}

TEST(Spacing, WholeFactorsOfTheRightParityDivideEvenly) {
  for (const int n : {2, 4, 6, 16, 64})
    expectLengths(std::vector<double>(size_t(n), 1.0 / n), lengths(kSpacingFractionalEven, n));
  for (const int n : {1, 3, 7, 63})
    expectLengths(std::vector<double>(size_t(n), 1.0 / n), lengths(kSpacingFractionalOdd, n));
}

/// From 1 to 64: places rise from 0 to 1, mirrored places are what is left to 1, and no segment is longer
/// than that of the next smaller allowed number.
TEST(Spacing, PlacesRiseAndAreSymmetric) {
  for (const int spacing : kAll)
    for (int units = kSegmentUnit; units <= 64 * kSegmentUnit; units += 7) {
      const int n = spacedSegments(spacing, units);
      ASSERT_GE(n * kSegmentUnit, units);
      EXPECT_EQ(spacedPlace(spacing, units, 0, n), 0.0);
      EXPECT_EQ(spacedPlace(spacing, units, n, n), 1.0);
      for (int i = 0; i < n; ++i) {
        const double here = spacedPlace(spacing, units, i, n);
        EXPECT_LT(here, spacedPlace(spacing, units, i + 1, n)) << spacing << " " << units << " " << i;
        EXPECT_NEAR(here + spacedPlace(spacing, units, n - i, n), 1.0, 1e-14);
      }
    }
}

/// Where a fractional number of segments changes, the new ones are as short as a step of the factor allows.
TEST(Spacing, FractionalPlacesAreContinuous) {
  for (const int spacing : {kSpacingFractionalEven, kSpacingFractionalOdd, kSpacingMoreton})
    for (int whole = 4; whole < 64; ++whole) {
      const int before = whole * kSegmentUnit, after = before + 1;
      const int n = spacedSegments(spacing, before), m = spacedSegments(spacing, after);
      for (int i = 0; i <= n; ++i) {
        double nearest = 1.0;
        for (int j = 0; j <= m; ++j)
          nearest = std::min(
              nearest, std::abs(spacedPlace(spacing, before, i, n) - spacedPlace(spacing, after, j, m)));
        EXPECT_LT(nearest, 1e-3) << spacing << " " << whole << " " << i;
      }
    }
}

/// A coarse level that deviates by (factor / coarse)^2 of the tolerance and a fine one of a quarter of that.
TEST(Spacing, MorphedLevelsKeepTheTolerance) {
  for (int units = 2 * kSegmentUnit + 1; units <= 64 * kSegmentUnit; ++units) {
    const int n = spacedSegments(kSpacingGeomorph, units);
    const double share = morphShare(units, n), factor = double(units) / kSegmentUnit;
    const double coarse = 4.0 * factor * factor / (n * n), fine = coarse / 4.0;
    EXPECT_LE((1.0 - share) * coarse + share * fine, 1.0 + 1e-12) << units;
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
  }
  EXPECT_EQ(morphShare(8 * kSegmentUnit, 8), 1.0);
  EXPECT_LT(morphShare(4 * kSegmentUnit + 1, 8), 2e-3);
}

/// Uniform patterns whose sides are moved: every sample of a side is used, and the triangles cover the domain
/// once.
TEST(Spacing, AdaptedPatternsCoverTheDomainWithTheSidesSamples) {
  const auto at = [](int rectangle, ivec4 s) {
    return rectangle == 1 ? glm::dvec2(double(s.x) / s.y, double(s.z) / s.w)
                          : glm::dvec2(s.x, s.y) / double(s.w);
  };
  for (const Domain domain : {Domain::Rectangle, Domain::Triangle})
    for (int n : {1, 2, 3, 5, 8, 13, 16})
      for (int code = 0; code < n * n; ++code) {
        const ivec4 sides(n, code % n + 1, code / n + 1, (code * 7) % n + 1);
        const int rectangle = domain == Domain::Rectangle ? 1 : 0;
        const PatternPlan plan = patternOf(domain, {n, n, n, n});
        std::vector<glm::dvec2> points;
        std::array<std::set<int>, 4> used;
        for (int slot = 0; slot < plan.vertices; ++slot) {
          const ivec4 s = adaptedSample(rectangle, patternSample(plan, slot), sides);
          points.push_back(at(rectangle, s));
          for (int side = 0; side < sidesOf(domain); ++side)
            for (int q = 0; q <= sides[side]; ++q)
              if (glm::length(at(rectangle, patternSideSample(rectangle, side, q, sides[side])) -
                              points.back()) < 1e-12)
                used[size_t(side)].insert(q);
        }
        for (int side = 0; side < sidesOf(domain); ++side)
          EXPECT_EQ(used[size_t(side)].size(), size_t(sides[side]) + 1) << n << " " << code << " " << side;
        double area = 0.0;
        for (const glm::uvec3& t : stripTriangles(patternIndices(plan))) {
          const glm::dvec2 a = points[t.x], b = points[t.y], c = points[t.z];
          const double twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
          EXPECT_GT(twice, -1e-12) << n << " " << code;
          area += 0.5 * twice;
        }
        EXPECT_NEAR(area, rectangle == 1 ? 1.0 : 0.5, 1e-9);
      }
}

}  // namespace
}  // namespace limen::surfaces

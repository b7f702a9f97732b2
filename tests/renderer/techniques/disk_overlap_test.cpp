// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/cones/disk_overlap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <utility>

namespace limen::techniques {
namespace {

using Triangle = std::array<glm::dvec2, 3>;
constexpr double kHalfTurn = std::numbers::pi;

/// By lines parallel to x: what a line has in common with the disk and with the triangle is an interval. With
/// 2 x 10^4 lines the integral errs by about h^1.5 = 1e-6 where the circle's boundary is steep.
DiskOverlap byLines(const Triangle& triangle) {
  constexpr int kLines = 20000;
  double area = 0.0;
  glm::dvec2 moment(0.0);
  for (int i = 0; i < kLines; ++i) {
    const double y = -1.0 + (i + 0.5) * 2.0 / kLines, half = std::sqrt(1.0 - y * y);
    double low = 1e300, high = -1e300;
    for (size_t k = 0; k < 3; ++k) {
      const glm::dvec2 p = triangle[k], q = triangle[(k + 1) % 3];
      if ((p.y < y) == (q.y < y)) continue;
      const double x = p.x + (q.x - p.x) * (y - p.y) / (q.y - p.y);
      low = std::min(low, x), high = std::max(high, x);
    }
    low = std::max(low, -half), high = std::min(high, half);
    if (low >= high) continue;
    const double strip = (high - low) * 2.0 / kLines;
    area += strip;
    moment += strip * glm::dvec2(0.5 * (low + high), y);
  }
  return {area, area > 0.0 ? moment / area : glm::dvec2(0.0)};
}

Triangle randomTriangle(std::mt19937& random) {
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  const double size = std::exp(1.2 * number(random));
  Triangle out;
  // Half of them nearly equilateral around the middle: all three edges may cross the circle twice.
  const bool regular = number(random) < 0.0;
  const double turn = kHalfTurn * number(random);
  for (int k = 0; k < 3; ++k)
    out[size_t(k)] = regular ? 1.6 * std::pow(size, 0.3) *
                                       glm::dvec2(std::cos(turn + 2.0944 * k), std::sin(turn + 2.0944 * k)) +
                                   0.4 * glm::dvec2(number(random), number(random))
                             : 1.5 * size * glm::dvec2(number(random), number(random));
  return out;
}

void expectEqual(const DiskOverlap& found, const DiskOverlap& expected, double bound) {
  EXPECT_NEAR(found.area, expected.area, bound);
  // The centroid of a small area is as uncertain as the area.
  if (expected.area <= 1e-3) return;
  EXPECT_NEAR(glm::length(found.centroid - expected.centroid), 0.0, bound / std::min(expected.area, 1.0));
}

TEST(DiskOverlaps, EqualAnIntegralOverLinesInAllCases) {
  std::mt19937 random(1);
  std::set<std::pair<int, int>> cases;
  for (int i = 0; i < 1500; ++i) {
    const Triangle triangle = randomTriangle(random);
    DiskCase found;
    const DiskOverlap expected = byLines(triangle), byCases = diskOverlapByCases(triangle, &found);
    cases.insert({found.cornersInside, found.crossings});
    expectEqual(byCases, expected, 1e-5);
    expectEqual(diskOverlapByEdges(triangle), expected, 1e-5);
    // Both are exact but for rounding.
    expectEqual(diskOverlapByEdges(triangle), byCases, 1e-11);
  }
  EXPECT_EQ(cases,
            (std::set<std::pair<int, int>>{{0, 0}, {0, 2}, {0, 4}, {0, 6}, {1, 2}, {1, 4}, {2, 2}, {3, 0}}));
}

TEST(DiskOverlaps, HaveTheSegmentOfTheCorrectedEquation) {
  // A half-disk's centroid is 4 / (3 pi) from the centre, that of a thin segment 1; for 1 rad the
  // specification has 0.927.
  EXPECT_NEAR(circularSegment(kHalfTurn).centroidDistance, 4.0 / (3.0 * kHalfTurn), 1e-15);
  EXPECT_NEAR(circularSegment(1e-6).centroidDistance, 1.0, 1e-12);
  EXPECT_NEAR(circularSegment(1.0).centroidDistance, 0.927, 5e-4);
  EXPECT_NEAR(circularSegment(2.0 * kHalfTurn).area, kHalfTurn, 1e-15);
  EXPECT_EQ(circularSegment(0.0).area, 0.0);
  // Where the series takes over from the formula, which has lost 5 digits by then: the area grows as the cube
  // of the angle.
  const double ratio = circularSegment(0.05).area / circularSegment(0.05 - 1e-9).area;
  EXPECT_NEAR(ratio, 1.0 + 3.0 * 1e-9 / 0.05, 1e-11);
}

// Pieces of a triangle add up to it: each common edge counts twice with opposite signs.
TEST(DiskOverlaps, OfAbuttingTrianglesAddUp) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const Triangle whole = randomTriangle(random);
    double u = number(random), v = number(random);
    if (u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
    const glm::dvec2 inner = whole[0] + u * (whole[1] - whole[0]) + v * (whole[2] - whole[0]);
    double sum = 0.0, byCases = 0.0;
    for (size_t k = 0; k < 3; ++k) {
      const Triangle piece = {whole[k], whole[(k + 1) % 3], inner};
      sum += diskOverlapByEdges(piece).area, byCases += diskOverlapByCases(piece).area;
    }
    EXPECT_NEAR(sum, diskOverlapByEdges(whole).area, 1e-12);
    EXPECT_NEAR(byCases, diskOverlapByEdges(whole).area, 1e-11);
  }
  // A fan that covers the disk.
  double covered = 0.0;
  for (int k = 0; k < 7; ++k)
    covered += diskOverlapByEdges(
                   Triangle{glm::dvec2(0.1, -0.2), 5.0 * glm::dvec2(std::cos(0.9 * k), std::sin(0.9 * k)),
                            5.0 * glm::dvec2(std::cos(k == 6 ? 2.0 * kHalfTurn : 0.9 * (k + 1)),
                                             std::sin(k == 6 ? 2.0 * kHalfTurn : 0.9 * (k + 1)))})
                   .area;
  EXPECT_NEAR(covered, kHalfTurn, 1e-12);
}

// Inside the disk the overlap is the triangle: its area is known however small it is. Corners have 16 digits,
// of which the size takes away as many as it has zeros.
TEST(DiskOverlaps, OfTinyTrianglesKeepTheirDigits) {
  for (const double size : {1e-2, 1e-4, 1e-6}) {
    const glm::dvec2 at(0.5, -0.3);
    const Triangle triangle = {at, at + size * glm::dvec2(1.0, 0.2), at + size * glm::dvec2(0.1, 0.9)};
    const double area = 0.5 * (1.0 * 0.9 - 0.1 * 0.2) * size * size, bound = 4e-16 / size;
    EXPECT_NEAR(diskOverlapByEdges(triangle).area / area, 1.0, bound);
    EXPECT_NEAR(diskOverlapByCases(triangle).area / area, 1.0, bound);
    EXPECT_NEAR(glm::length(diskOverlapByEdges(triangle).centroid - at - size * glm::dvec2(1.1, 1.1) / 3.0),
                0.0, 1e-15);
  }
}

TEST(DiskOverlaps, AreSoundForDegenerateTriangles) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Triangle& triangle : {Triangle{glm::dvec2(0.0), glm::dvec2(0.0), glm::dvec2(0.0)},
                                   {glm::dvec2(-3.0), glm::dvec2(3.0), glm::dvec2(3.0)},
                                   {glm::dvec2(-2.0, 0.0), glm::dvec2(0.5, 0.0), glm::dvec2(2.0, 0.0)},
                                   // Only a corner or an edge touches the circle.
                                   {glm::dvec2(1.0, 0.0), glm::dvec2(3.0, 1.0), glm::dvec2(3.0, -1.0)},
                                   {glm::dvec2(-5.0, 1.0), glm::dvec2(5.0, 1.0), glm::dvec2(0.0, 7.0)},
                                   {glm::dvec2(nan), glm::dvec2(1.0), glm::dvec2(0.0)}}) {
    EXPECT_NEAR(diskOverlapByEdges(triangle).area, 0.0, 1e-12);
    EXPECT_NEAR(diskOverlapByCases(triangle).area, 0.0, 1e-12);
  }
  // Corners on the circle: an inscribed equilateral triangle.
  Triangle inscribed;
  for (int k = 0; k < 3; ++k)
    inscribed[size_t(k)] = {std::cos(2.0 * kHalfTurn * k / 3.0), std::sin(2.0 * kHalfTurn * k / 3.0)};
  for (const double grown : {1.0 - 1e-15, 1.0, 1.0 + 1e-15, 1.0 + 1e-9}) {
    Triangle triangle = inscribed;
    for (glm::dvec2& corner : triangle) corner *= grown;
    // A tiny growth adds twice its amount of the area at most.
    EXPECT_NEAR(diskOverlapByEdges(triangle).area, 0.75 * std::sqrt(3.0), 3e-9);
    EXPECT_NEAR(diskOverlapByCases(triangle).area, 0.75 * std::sqrt(3.0), 3e-9);
  }
  // Edges that all touch the circle: the disk lies inside.
  for (const double grown : {1.0 - 1e-12, 1.0, 1.0 + 1e-12}) {
    Triangle triangle = inscribed;
    for (glm::dvec2& corner : triangle) corner *= 2.0 * grown;
    EXPECT_NEAR(diskOverlapByEdges(triangle).area, kHalfTurn, 1e-9);
    EXPECT_NEAR(diskOverlapByCases(triangle).area, kHalfTurn, 1e-9);
  }
  // Vast ones.
  for (const double size : {1e4, 1e8})
    EXPECT_NEAR(
        diskOverlapByEdges(Triangle{glm::dvec2(-size, 0.0), glm::dvec2(size, 0.0), glm::dvec2(0.0, size)})
            .area,
        0.5 * kHalfTurn, 1e-9);
}

}  // namespace
}  // namespace limen::techniques

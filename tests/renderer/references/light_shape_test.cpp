// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/references/light_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/references/convex_pieces.h"
#include "renderer/scene/light.h"

namespace limen::references {
namespace {

scene::AreaLight lightOf(scene::LightShape shape) { return scene::withShape(scene::AreaLight{}, shape); }

/// Concave, with a vertex on a straight side.
std::vector<glm::dvec2> notchedSquare() {
  return {{0.0, 0.0}, {0.5, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.6, 1.0}, {0.5, 0.2}, {0.4, 1.0}, {0.0, 1.0}};
}

double areaOf(const Triangle2& t) {
  const glm::dvec2 a = t[1] - t[0], b = t[2] - t[0];
  return 0.5 * (a.x * b.y - a.y * b.x);
}

TEST(Triangulate, TrianglesOfAConcavePolygonAreCounterClockwiseAndAddUpToItsArea) {
  double sum = 0.0;
  for (const Triangle2& triangle : triangulate(notchedSquare())) {
    EXPECT_GE(areaOf(triangle), 0.0);
    sum += areaOf(triangle);
  }
  // The unit square less a triangle of base 0.2 and height 0.8.
  EXPECT_NEAR(sum, 1.0 - 0.5 * 0.2 * 0.8, 1e-12);
}

TEST(Triangulate, TrianglesOfAConcavePolygonStayInside) {
  for (const Triangle2& triangle : triangulate(notchedSquare()))
    if (areaOf(triangle) > 0.0) {
      EXPECT_TRUE(scene::polygonContains(notchedSquare(), (triangle[0] + triangle[1] + triangle[2]) / 3.0));
    }
}

/// Maps a fine grid of the square and compares the share that lands in the half u < threshold with the share
/// of the shape's area there. A grid of N x N points resolves a boundary curve of length L <= 4 to 4 / N.
void expectAreasKept(const scene::AreaLight& light, double threshold, double expectedShare) {
  constexpr int kSide = 400;
  const LightShapeMap map(light);
  int inside = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec2 unit = map((glm::dvec2(x, y) + 0.5) / double(kSide));
      ASSERT_TRUE(light.contains(unit)) << unit.x << ' ' << unit.y;
      inside += unit.x < threshold;
    }
  EXPECT_NEAR(inside / double(kSide * kSide), expectedShare, 4.0 / kSide);
}

TEST(LightShapeMap, DiscKeepsAreas) {
  // Circle of radius 1/2; the segment left of x = 1/4 has the height 1/4: r^2 (acos(1/2) - 1/2 sqrt(3/4)).
  const double segment = 0.25 * (std::acos(0.5) - 0.5 * std::sqrt(0.75));
  expectAreasKept(lightOf(scene::LightShape::Disc), 0.25, segment / (0.25 * std::numbers::pi));
}

TEST(LightShapeMap, HexagonKeepsAreas) {
  // Of the hexagon's area 3/4, the left tip up to x = 1/4 is a triangle of base 1 and height 1/4.
  expectAreasKept(lightOf(scene::LightShape::Polygon), 0.25, 0.125 / 0.75);
}

TEST(LightShapeMap, ConcavePolygonKeepsAreas) {
  scene::AreaLight light;
  light.shape = scene::LightShape::Polygon;
  light.outline = notchedSquare();
  expectAreasKept(light, 0.4, 0.4 / 0.92);
}

TEST(ConvexPolygon, AreaInTheUnitDiscIsThatOfTheSegment) {
  // The disc right of x = t: acos t - t sqrt(1 - t^2).
  for (const double t : {-1.5, -1.0, -0.7, 0.0, 0.3, 0.999, 1.0, 2.0}) {
    const ConvexPolygon right = {{t, -3.0}, {5.0, -3.0}, {5.0, 3.0}, {t, 3.0}};
    const double clamped = glm::clamp(t, -1.0, 1.0);
    EXPECT_NEAR(right.areaInUnitDisc(), std::acos(clamped) - clamped * std::sqrt(1.0 - clamped * clamped),
                1e-12)
        << t;
  }
}

TEST(ConvexPolygon, AreaInTheUnitDiscOfAPolygonInsideIsItsOwn) {
  const ConvexPolygon inside = {{0.1, 0.1}, {0.6, 0.2}, {0.3, 0.7}};
  EXPECT_NEAR(inside.areaInUnitDisc(), inside.area(), 1e-14);
}

ConvexRegion rectangle(glm::dvec2 low, glm::dvec2 high) {
  ConvexRegion region;
  region.planes = {HalfPlane{{1.0, 0.0}, -low.x}, HalfPlane{{-1.0, 0.0}, high.x},
                   HalfPlane{{0.0, 1.0}, -low.y}, HalfPlane{{0.0, -1.0}, high.y}};
  region.count = 4;
  region.low = low, region.high = high;
  return region;
}

double left(const ConvexPieces& pieces) {
  double sum = 0.0;
  for (const ConvexPolygon& piece : pieces.pieces()) sum += piece.area();
  return sum;
}

const ConvexPolygon kSquare = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};

TEST(ConvexPieces, OverlapsAreTakenOnce) {
  ConvexPieces pieces({kSquare});
  pieces.subtract(rectangle({-0.5, -0.5}, {0.5, 0.5}));
  EXPECT_NEAR(left(pieces), 3.0, 1e-12);
  pieces.subtract(rectangle({0.0, 0.0}, {2.0, 2.0}));
  EXPECT_NEAR(left(pieces), 3.0 - (1.0 - 0.25), 1e-12);
  pieces.subtract(rectangle({-0.4, -0.4}, {0.1, 0.1}));
  EXPECT_NEAR(left(pieces), 2.25, 1e-12);
}

TEST(ConvexPieces, TilesThatShareEdgesLeaveNothing) {
  ConvexPieces pieces({kSquare});
  constexpr int kTiles = 13;
  for (int y = 0; y < kTiles; ++y)
    for (int x = 0; x < kTiles; ++x)
      pieces.subtract(rectangle(glm::dvec2(x, y) * (2.0 / kTiles) - 1.0,
                                glm::dvec2(x + 1, y + 1) * (2.0 / kTiles) - 1.0));
  EXPECT_NEAR(left(pieces), 0.0, 1e-11);
}

TEST(ConvexPieces, RandomRectanglesCoverWhatAGridOfPointsSays) {
  uint32_t state = 7;
  const auto random = [&] {
    return 2.0 * ((state = state * 1664525U + 1013904223U) >> 8) / double(1 << 24) - 1.0;
  };
  ConvexPieces pieces({kSquare});
  std::vector<ConvexRegion> regions;
  for (int i = 0; i < 40; ++i) {
    const glm::dvec2 a(random(), random()), half = 0.05 + 0.1 * glm::abs(glm::dvec2(random(), random()));
    regions.push_back(rectangle(a - half, a + half));
    pieces.subtract(regions.back());
  }
  constexpr int kSide = 2000;
  int outside = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const glm::dvec2 p = (glm::dvec2(x, y) + 0.5) * (2.0 / kSide) - 1.0;
      bool covered = false;
      for (const ConvexRegion& r : regions)
        covered = covered || (p.x > r.low.x && p.x < r.high.x && p.y > r.low.y && p.y < r.high.y);
      outside += !covered;
    }
  // The 160 edges are at most 0.3 long; each moves the count by half a cell over its length at most.
  EXPECT_NEAR(left(pieces), 4.0 * outside / double(kSide * kSide), 160 * 0.3 * 0.5 * (2.0 / kSide));
}

}  // namespace
}  // namespace limen::references

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/neighbours.h"

#include <gtest/gtest.h>

#include "tests/renderer/surfaces/bezier_oracle.h"

namespace limen::surfaces {
namespace {

/// A flat grid of squares, each a patch of degree 1.
PatchSet squares(int columns, int rows) {
  PatchSet set;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x)
      addRectangle(set, 1, 1,
                   std::array<glm::dvec4, 4>{glm::dvec4(x, y, 0, 1), glm::dvec4(x + 1, y, 0, 1),
                                             glm::dvec4(x, y + 1, 0, 1), glm::dvec4(x + 1, y + 1, 0, 1)});
  return set;
}

TEST(Neighbours, OfAGridAreTheSquaresBeside) {
  PatchSet set = squares(3, 2);
  const SideCounts counts = findNeighbours(set);
  EXPECT_EQ(counts.shared, 2U * (2 * 2 + 3));
  EXPECT_EQ(counts.open, 10U);
  EXPECT_EQ(counts.collapsed + counts.crowded, 0U);
  // The middle of the lower row.
  const auto& sides = set.neighbours[1];
  const auto expect = [&](size_t side, int patch, int theirs) {
    EXPECT_EQ(sides[side].patch, patch);
    EXPECT_EQ(sides[side].side, theirs);
    EXPECT_TRUE(sides[side].reversed);
  };
  EXPECT_EQ(sides[0].patch, -1);
  expect(1, 2, 3), expect(2, 4, 0), expect(3, 0, 1);
}

/// A patch that is turned over runs along its neighbour in the same direction.
TEST(Neighbours, OfPatchesThatAreOrientedDifferentlyAreNotReversed) {
  PatchSet set = squares(2, 1);
  std::swap(set.points[4], set.points[6]), std::swap(set.points[5], set.points[7]);
  findNeighbours(set);
  EXPECT_EQ(set.neighbours[0][1].patch, 1);
  EXPECT_FALSE(set.neighbours[0][1].reversed);
}

TEST(Neighbours, AreNotFoundWhereThreeMeetOrASideIsAPoint) {
  PatchSet set = squares(2, 1);
  PatchSet again = squares(1, 1);
  append(set, again);  // the first square twice
  SideCounts counts = findNeighbours(set);
  EXPECT_EQ(counts.crowded, 3U);
  EXPECT_EQ(counts.shared, 6U);  // the copies' other three sides
  EXPECT_EQ(set.neighbours[0][1].patch, -1);

  set = squares(1, 1);
  set.points[1] = set.points[0];
  counts = findNeighbours(set);
  EXPECT_EQ(counts.collapsed, 1U);
  EXPECT_EQ(counts.open, 3U);
}

/// Zeros of either sign are the same number, and triangles meet rectangles.
TEST(Neighbours, AreFoundBetweenKindsOfPatches) {
  PatchSet set = squares(1, 1);
  addTriangle(set, 1,
              std::array<glm::dvec4, 3>{glm::dvec4(0.0, -0.0, 0.0, 1.0), glm::dvec4(0.5, -1.0, 0.0, 1.0),
                                        glm::dvec4(1.0, 0.0, -0.0, 1.0)});
  findNeighbours(set);
  EXPECT_EQ(set.neighbours[0][0].patch, 1);
  EXPECT_EQ(set.neighbours[0][0].side, 2);
  EXPECT_EQ(set.neighbours[1][2].patch, 0);
}

TEST(Neighbours, AreKeptWhenSetsAreAppended) {
  PatchSet set = squares(2, 1), other = squares(1, 2);
  findNeighbours(set), findNeighbours(other);
  append(set, other);
  ASSERT_EQ(set.neighbours.size(), 4U);
  EXPECT_EQ(set.neighbours[2][2].patch, 3);
  EXPECT_EQ(set.neighbours[3][0].patch, 2);
  EXPECT_EQ(set.neighbours[2][0].patch, -1);
}

}  // namespace
}  // namespace limen::surfaces

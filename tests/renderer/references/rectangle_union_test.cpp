// SPDX-License-Identifier: BSD-3-Clause
// Unions of rectangles with whole coordinates against counting the unit squares that they cover.
#include "renderer/references/rectangle_union.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace limen::references {
namespace {

constexpr int kBoard = 24;

struct Board {
  std::vector<glm::ivec4> rectangles;

  bool covers(int x, int y) const {
    return std::any_of(rectangles.begin(), rectangles.end(),
                       [&](glm::ivec4 r) { return r.x <= x && x < r.z && r.y <= y && y < r.w; });
  }
  RectangleUnion sweep() const {
    RectangleUnion out;
    for (const glm::ivec4 r : rectangles) out.add({r.x, r.y}, {r.z, r.w});
    return out;
  }
};

Board randomBoard(std::mt19937& random, int count) {
  std::uniform_int_distribution<int> place(0, kBoard);
  Board board;
  for (int i = 0; i < count; ++i) {
    const int a = place(random), b = place(random), c = place(random), d = place(random);
    board.rectangles.emplace_back(std::min(a, b), std::min(c, d), std::max(a, b), std::max(c, d));
  }
  return board;
}

TEST(RectangleUnion, HasTheAreaOfTheSquaresThatAnyRectangleCovers) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    const Board board = randomBoard(random, 1 + round % 40);
    int squares = 0;
    for (int y = 0; y < kBoard; ++y)
      for (int x = 0; x < kBoard; ++x) squares += board.covers(x, y);
    // Sums of whole numbers have no rounding.
    EXPECT_EQ(board.sweep().area(), squares) << round;
  }
}

TEST(RectangleUnion, InAHalfPlaneHasTheAreaOfTheSquaresInIt) {
  std::mt19937 random(2);
  std::uniform_int_distribution<int> offset(-kBoard, 2 * kBoard);
  for (int round = 0; round < 300; ++round) {
    const Board board = randomBoard(random, 1 + round % 30);
    // x + y >= k cuts the squares with x + y = k - 1 in halves.
    const int k = offset(random);
    double expected = 0.0;
    for (int y = 0; y < kBoard; ++y)
      for (int x = 0; x < kBoard; ++x)
        if (board.covers(x, y)) expected += x + y >= k ? 1.0 : x + y == k - 1 ? 0.5 : 0.0;
    const double root = std::sqrt(0.5);
    EXPECT_NEAR(board.sweep().area({{root, root}, -root * k}), expected, 1e-9) << round;
    // Nothing is lost between a half-plane and its complement.
    RectangleUnion all = board.sweep();
    EXPECT_NEAR(all.area({{root, root}, -root * k}) + all.area({{-root, -root}, root * k}), all.area(), 1e-9);
  }
}

TEST(RectangleUnion, DoesNotDependOnOrderOrRepetition) {
  std::mt19937 random(3);
  Board board = randomBoard(random, 25);
  const double area = board.sweep().area();
  std::shuffle(board.rectangles.begin(), board.rectangles.end(), random);
  const std::vector<glm::ivec4> again = board.rectangles;
  board.rectangles.insert(board.rectangles.end(), again.begin(), again.end());
  EXPECT_EQ(board.sweep().area(), area);
}

TEST(RectangleUnion, OfNothingIsNothing) {
  RectangleUnion none;
  EXPECT_EQ(none.area(), 0.0);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  none.add({0.0, 0.0}, {0.0, 1.0});
  none.add({0.5, 0.5}, {0.25, 1.0});
  none.add({kNone, 0.0}, {1.0, 1.0});
  none.add({0.0, 0.0}, {1.0, kNone});
  EXPECT_TRUE(none.empty());
  EXPECT_EQ(none.area(), 0.0);
}

}  // namespace
}  // namespace limen::references

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/ray_tracing/wide_bvh.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>
#include <functional>

#include "renderer/ray_tracing/ray_tracing_bindings.h"
#include "tests/renderer/ray_tracing/soups.h"

namespace limen::ray_tracing {
namespace {

/// Checks that each triangle lies in one leaf and in the boxes of all nodes above it; returns the triangles
/// found.
class Walk {
 public:
  explicit Walk(const WideBvh& tree) : tree_(tree), visits_(tree.nodes().size()) {}

  std::vector<int> leaves(size_t triangles) {
    found_.assign(triangles, 0);
    if (!tree_.nodes().empty()) visit(0, {}, 1);
    for (const int visits : visits_) EXPECT_EQ(visits, 1);
    EXPECT_EQ(deepest_, tree_.levels());
    return found_;
  }
  size_t outside() const { return outside_; }

 private:
  struct Box {
    glm::dvec3 low, high;
  };

  void visit(uint32_t at, std::vector<Box> around, int level) {
    ASSERT_LT(at, tree_.nodes().size());
    ASSERT_LE(level, kRayLevels);
    deepest_ = std::max(deepest_, level);
    ++visits_[at];
    const WideNode& node = tree_.nodes()[at];
    uint32_t next = node.firstNode;
    for (uint32_t child = 0; child < WideNode::kChildren; ++child) {
      const uint32_t meta = node.meta[child];
      if (meta == 0) continue;
      Box box;
      for (int axis = 0; axis < 3; ++axis)
        box.low[axis] = node.lowOf(axis, child), box.high[axis] = node.highOf(axis, child);
      std::vector<Box> within = around;
      within.push_back(box);
      if (node.inner >> child & 1U) {
        EXPECT_EQ(meta, 0x38U + child);
        visit(next++, within, level + 1);
      } else {
        const auto count = static_cast<uint32_t>(std::popcount(meta >> 5U));
        EXPECT_LE(count, WideNode::kMostLeafTriangles);
        EXPECT_EQ(meta >> 5U, (1U << count) - 1U);
        EXPECT_LE((meta & 31U) + count, 24U);
        for (uint32_t i = 0; i < count; ++i) leaf(node.firstTriangle + (meta & 31U) + i, within);
      }
    }
  }

  void leaf(uint32_t at, const std::vector<Box>& around) {
    ASSERT_LT(at, tree_.triangles().size());
    const LeafTriangle& triangle = tree_.triangles()[at];
    ++found_.at(triangle.triangle);
    for (const glm::dvec3 corner : {glm::dvec3(triangle.a), glm::dvec3(triangle.b), glm::dvec3(triangle.c)})
      for (const Box& box : around)
        for (int axis = 0; axis < 3; ++axis)
          outside_ += corner[axis] < box.low[axis] || corner[axis] > box.high[axis];
  }

  const WideBvh& tree_;
  std::vector<int> visits_, found_;
  size_t outside_ = 0;
  int deepest_ = 0;
};

void expectSound(const Soup& soup, size_t degenerate, const char* name) {
  const WideBvh tree(soup.vertices, soup.triangles);
  Walk walk(tree);
  const std::vector<int> leaves = walk.leaves(soup.triangles.size());
  const size_t proper = soup.triangles.size() - degenerate;
  for (size_t i = 0; i < leaves.size(); ++i) EXPECT_EQ(leaves[i], i < proper ? 1 : 0) << name << ' ' << i;
  EXPECT_EQ(walk.outside(), 0U) << name;
  EXPECT_EQ(tree.triangles().size(), proper) << name;
}

TEST(WideBvh, EachTriangleLiesInOneLeafAndInEveryBoxAboveIt) {
  for (const int count : {1, 2, 3, 4, 24, 25, 1000}) expectSound(randomSoup(1, count, 0.1), 0, "soup");
  Soup soup = randomSoup(2, 3000, 0.3);
  const size_t degenerate = addDegenerate(soup);
  expectSound(soup, degenerate, "degenerate");
  expectSound(slivers(3, 2000), 0, "slivers");
  expectSound(sphere(4), 0, "sphere");
  expectSound(randomSoup(4, 2000, 0.1, {1e4, -3e4, 2e4}), 0, "far from the origin");
  Soup scales;
  Dice dice(5);
  for (int i = 0; i < 3000; ++i) {
    const double size = std::pow(10.0, dice.in(-30.0, 30.0));
    scales.add(dice.inCube(size), dice.inCube(size), dice.inCube(size));
  }
  expectSound(scales, 0, "all scales");
}

TEST(WideBvh, TreesOfMoreThanOneCorePerNodeAreSound) { expectSound(randomSoup(6, 150000, 0.01), 0, "large"); }

TEST(WideBvh, ManyTrianglesInOnePlaceDoNotDeepenTheTree) {
  Soup alike;
  for (int i = 0; i < 5000; ++i) alike.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  expectSound(alike, 0, "alike");
  EXPECT_LE(WideBvh(alike.vertices, alike.triangles).levels(), 6);
  // Each triangle a fifth as large as the one before, about one point: what a split by area peels off one at
  // a time.
  Soup nested;
  for (int i = 0; i < 5000; ++i) {
    const auto size = static_cast<float>(std::pow(5.0, -double(i % 50)));
    nested.add({size, 0, 0}, {0, size, 0}, {0, 0, size});
  }
  expectSound(nested, 0, "nested");
}

TEST(WideBvh, IsTheSameEveryTime) {
  const Soup soup = randomSoup(7, 100000, 0.02);
  const WideBvh one(soup.vertices, soup.triangles), other(soup.vertices, soup.triangles);
  ASSERT_EQ(one.nodes().size(), other.nodes().size());
  ASSERT_EQ(one.triangles().size(), other.triangles().size());
  EXPECT_EQ(std::memcmp(one.nodes().data(), other.nodes().data(), one.nodes().size() * sizeof(WideNode)), 0);
  EXPECT_EQ(std::memcmp(one.triangles().data(), other.triangles().data(),
                        one.triangles().size() * sizeof(LeafTriangle)),
            0);
}

TEST(WideBvh, ASceneWithoutTrianglesHasNoNodes) {
  EXPECT_TRUE(WideBvh({}, {}).nodes().empty());
  Soup soup;
  addDegenerate(soup);
  EXPECT_TRUE(WideBvh(soup.vertices, soup.triangles).nodes().empty());
}

}  // namespace
}  // namespace limen::ray_tracing

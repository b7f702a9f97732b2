// SPDX-License-Identifier: BSD-3-Clause
// Trees that are not complete and binary: what holds of those holds of these, and cuts are those of the
// recursion.
#include <algorithm>
#include <bit>
#include <set>

#include "experiments/base/error.h"
#include "renderer/many_lods/gpu_tree.h"
#include "renderer/many_lods/multi_cut.h"
#include "renderer/many_lods/unbalanced_tree.h"
#include "tests/renderer/many_lods/many_lods_fixture.h"

namespace limen::many_lods {
namespace {

SphereTree unbalancedTreeOf(const Triangles& of, int depth) {
  return buildUnbalancedTree(of.positions, of.triangles, glm::dvec3(0.0),
                             {.depth = depth, .leafScale = 1.5, .seed = 7});
}

void expectLinkedTree(const SphereTree& tree, const std::vector<glm::vec4>& spheres) {
  uint32_t leaves = 0;
  std::set<std::pair<uint32_t, uint32_t>> points;
  for (uint32_t node = kRootNode; node < 2 * tree.leafCount(); ++node) {
    const TreeLink& link = tree.links[node];
    if (link.firstChild == 0) {
      ++leaves;
      ASSERT_EQ(link.height, 0U);
      ASSERT_EQ(link.leaves, 1U);
      points.emplace(tree.samples[node].triangle, tree.samples[node].place);
      continue;
    }
    ASSERT_GT(link.firstChild, node);
    ASSERT_EQ(link.firstChild % 2, 0U);
    uint32_t below = 0;
    for (const uint32_t child : {link.firstChild, link.firstChild + 1}) {
      ASSERT_EQ(tree.links[child].parent, node);
      ASSERT_LT(tree.links[child].height, link.height);
      below += tree.links[child].leaves;
      const double needed =
          glm::distance(glm::dvec3(spheres[child]), glm::dvec3(spheres[node])) + double(spheres[child].w);
      // With what the cuts rely on: 16 u of the parent and more.
      ASSERT_LE(needed * (1.0 + 0.9 * kSphereSlack), spheres[node].w) << "node " << node;
    }
    ASSERT_EQ(below, link.leaves);
  }
  EXPECT_EQ(leaves, tree.leafCount());
  EXPECT_LE(tree.height(), kMostTreeHeight);
}

double volumeOf(const SphereTree& tree) {
  double sum = 0.0;
  for (uint32_t node = kRootNode; node < 2 * tree.leafCount(); ++node)
    sum += std::pow(tree.spheres[node].w, 3.0);
  return sum;
}

TEST(UnbalancedTrees, HaveEveryPointOnceAndParentsContainChildrenAfterRounding) {
  for (const double shift : {0.0, 1e4}) {
    Triangles of = bumpyBalls();
    for (glm::dvec3& position : of.positions) position += shift;
    const SphereTree tree = unbalancedTreeOf(of, 11);
    expectLinkedTree(tree, tree.spheres);
    // The same points as those of the complete tree.
    std::multiset<std::pair<uint32_t, uint32_t>> found, expected;
    for (const SurfaceSample& sample : treeOf(of, 11).samples)
      expected.emplace(sample.triangle, sample.place);
    for (uint32_t node = kRootNode; node < 2 * tree.leafCount(); ++node)
      if (tree.links[node].firstChild == 0)
        found.emplace(tree.samples[node].triangle, tree.samples[node].place);
    EXPECT_EQ(found, expected);
  }
}

// Five balls of very different sizes, far apart: a median cuts through the largest, which has most of the
// points; the least volume leaves every ball whole until it is alone.
TEST(UnbalancedTrees, KeepApartWhatLiesApart) {
  Triangles of;
  const std::vector<double> middles = {0.0, 100.0, 200.0, 300.0, 400.0};
  for (size_t ball = 0; ball < middles.size(); ++ball) {
    const double radius = 1.0 + 2.0 * double(ball);
    for (int i = 0; i < 60; ++i) {
      const double a = 2.0 * std::numbers::pi * i / 60.0, b = 2.0 * std::numbers::pi * (i + 1) / 60.0;
      const glm::dvec3 middle(middles[ball], 0.0, 0.0);
      of.add(middle, middle + radius * glm::dvec3(std::cos(a), 0.0, std::sin(a)),
             middle + radius * glm::dvec3(std::cos(b), 0.0, std::sin(b)));
    }
  }
  const SphereTree tree = unbalancedTreeOf(of, 9);
  // Nodes of points of one ball alone whose parent has those of others: one for each ball.
  int balls = 0;
  const auto isOne = [&](uint32_t node) { return tree.spheres[node].w < 20.0F; };
  for (uint32_t node = 2; node < 2 * tree.leafCount(); ++node)
    balls += isOne(node) && !isOne(tree.links[node].parent) ? 1 : 0;
  EXPECT_EQ(balls, 5);
  EXPECT_LT(volumeOf(tree), 0.8 * volumeOf(treeOf(of, 9)));
}

TEST(UnbalancedTrees, CoincidentPointsStayWithinTheHeight) {
  Triangles of;
  of.add({1, 1, 1}, {1 + 1e-12, 1, 1}, {1, 1 + 1e-12, 1});
  of.add({5, 1, 1}, {5, 1 + 1e-9, 1}, {5 + 1e-9, 1, 1});
  const SphereTree tree = unbalancedTreeOf(of, 10);
  expectLinkedTree(tree, tree.spheres);
}

class TreeForms : public gl::GlTest {
 protected:
  static std::vector<glm::uvec2> sorted(std::vector<glm::uvec2> list) {
    std::sort(list.begin(), list.end(),
              [](glm::uvec2 a, glm::uvec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); });
    return list;
  }
  static std::vector<CutView> viewsOf(const SphereTree& tree, uint32_t count, uint32_t seed,
                                      double epsilonPx = 2.0) {
    std::mt19937 random(seed);
    // Views at points of the surface, of which a linked tree has them elsewhere, are those of the complete
    // one.
    std::vector<CutView> out;
    const SphereTree complete = treeOf(bumpyBalls(), tree.depth);
    for (uint32_t i = 0; i < count; ++i) out.push_back(anyView(random, complete, epsilonPx));
    return out;
  }
  static std::vector<glm::uvec2> expected(const SphereTree& tree, const std::vector<CutView>& views,
                                          int arityBits) {
    std::vector<glm::uvec2> out;
    for (uint32_t i = 0; i < views.size(); ++i)
      for (const uint32_t node : recursiveCut(tree, views[i], arityBits)) out.emplace_back(node, i);
    return out;
  }

  struct Form {
    SphereTree tree;
    int arityBits;
  };
  static std::vector<Form> forms() {
    const Triangles of = bumpyBalls();
    std::vector<Form> out;
    for (const int bits : {1, 2, 3}) out.push_back({treeOf(of, 12), bits});
    out.push_back({unbalancedTreeOf(of, 11), 1});
    return out;
  }
};

TEST_F(TreeForms, CutsEqualTheRecursion) {
  for (const Form& form : forms()) {
    const GpuTree onGpu(context(), form.tree);
    constexpr uint32_t kViews = 150;
    const int arity = 1 << form.arityBits;
    MultiCut basic(context(), kViews, onGpu.shape(), 1U << 19, BasicCuts{arity});
    MultiCut incremental(context(), kViews, onGpu.shape(), 1U << 19,
                         IncrementalCuts{arity, 5, CutOrder::Free});
    for (uint32_t frame = 0; frame < 4; ++frame) {
      // Half of the views are elsewhere in every frame.
      std::vector<CutView> views = viewsOf(form.tree, kViews, 31),
                           others = viewsOf(form.tree, kViews, 50 + frame);
      std::copy_n(others.begin(), kViews / 2, views.begin());
      const gl::Buffer onGpuViews(views);
      basic.update(onGpu.nodes(), onGpuViews);
      incremental.update(onGpu.nodes(), onGpuViews);
      const std::vector<glm::uvec2> right = sorted(expected(form.tree, views, form.arityBits));
      ASSERT_GT(right.size(), 10 * kViews);
      ASSERT_EQ(sorted(basic.list()), right) << form.arityBits << " bits, frame " << frame;
      ASSERT_EQ(sorted(incremental.list()), right) << form.arityBits << " bits, frame " << frame;
      const CutFaults faults = faultsOf(incremental.list(), kViews, form.tree);
      ASSERT_EQ(faults.uncovered + faults.doubled, 0U);
    }
  }
}

TEST_F(TreeForms, LazyCutsAreWholeInEveryFrameAndArriveAtRest) {
  for (const Form& form : forms())
    for (const int edges : {1, 3}) {
      const GpuTree onGpu(context(), form.tree);
      constexpr uint32_t kViews = 100;
      MultiCut lazy(context(), kViews, onGpu.shape(), 1U << 18, LazyCuts{1 << form.arityBits, edges});
      for (uint32_t frame = 0; frame < 6; ++frame) {
        const std::vector<CutView> views = viewsOf(form.tree, kViews, 70 + frame / 2);
        lazy.update(onGpu.nodes(), gl::Buffer(views));
        const CutFaults faults = faultsOf(lazy.list(), kViews, form.tree);
        ASSERT_EQ(faults.uncovered + faults.doubled, 0U) << form.arityBits << " bits, frame " << frame;
      }
      const std::vector<CutView> rest = viewsOf(form.tree, kViews, 90);
      for (int frame = 0; frame < form.tree.height() + 1; ++frame)
        lazy.update(onGpu.nodes(), gl::Buffer(rest));
      EXPECT_EQ(lazy.list(), expected(form.tree, rest, form.arityBits)) << form.arityBits << " bits";
    }
}

// A node is split into all of its children or not at all.
TEST_F(TreeForms, OverfullListsLoseNothing) {
  for (const Form& form : forms())
    for (const CutMode& mode :
         {CutMode(BasicCuts{1 << form.arityBits}), CutMode(IncrementalCuts{1 << form.arityBits, 5}),
          CutMode(LazyCuts{1 << form.arityBits, 2})}) {
      const GpuTree onGpu(context(), form.tree);
      constexpr uint32_t kViews = 60;
      MultiCut cut(context(), kViews, onGpu.shape(), 1003, mode);
      for (uint32_t frame = 0; frame < 4; ++frame) {
        cut.update(onGpu.nodes(), gl::Buffer(viewsOf(form.tree, kViews, 110 + frame)));
        const std::vector<glm::uvec2> list = cut.list();
        const CutFaults faults = faultsOf(list, kViews, form.tree);
        ASSERT_EQ(faults.uncovered + faults.doubled, 0U) << form.arityBits << " bits, frame " << frame;
        ASSERT_LE(list.size(), 1003U);
        EXPECT_GT(cut.control().refused, 0U);
        if (form.arityBits > 1) {
          for (const glm::uvec2 entry : list)
            ASSERT_EQ((std::bit_width(entry.x) - 1) % form.arityBits, 0) << "node " << entry.x;
        }
      }
    }
}

TEST_F(TreeForms, RefuseArityThatDoesNotDivideTheLevels) {
  EXPECT_THROW(MultiCut(context(), 1, 11, 1024, BasicCuts{4}), Error);
}

// A few roundings of 2^-24 a level, relative to the coordinates' size.
TEST_F(TreeForms, UpdatesOfLinkedTreesEqualTheMergeOnTheCpu) {
  Triangles of = bumpyBalls();
  SphereTree tree = unbalancedTreeOf(of, 10);
  const GpuTree onGpu(context(), tree);
  for (glm::dvec3& p : of.positions) p = {p.x + 0.3 * std::sin(p.y), p.y + 0.01 * p.x * p.x, p.z * 1.2};
  std::vector<glm::vec3> moved;
  for (const glm::dvec3 p : of.positions) moved.emplace_back(p);
  const gl::Buffer positions(moved), indices(of.triangles);
  onGpu.update(positions, indices, true);
  const std::vector<glm::vec4> spheres = onGpu.nodes().read<glm::vec4>();
  for (uint32_t node = kRootNode; node < 2 * tree.leafCount(); ++node)
    if (tree.links[node].firstChild == 0)
      tree.spheres[node] =
          glm::vec4(glm::vec3(positionOf(tree.samples[node], of.positions, of.triangles)), tree.leafRadius);
  mergeUpwards(tree);
  for (uint32_t node = kRootNode; node < 2 * tree.leafCount(); ++node) {
    ASSERT_LT(glm::distance(glm::vec3(spheres[node]), glm::vec3(tree.spheres[node])), 2e-4F)
        << "node " << node;
    ASSERT_NEAR(spheres[node].w, tree.spheres[node].w, 2e-4F) << "node " << node;
  }
  expectLinkedTree(tree, spheres);
}

}  // namespace
}  // namespace limen::many_lods

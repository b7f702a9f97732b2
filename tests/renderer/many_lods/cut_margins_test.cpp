// SPDX-License-Identifier: BSD-3-Clause
// Cuts whose nodes are tested only where something has moved by more than the last test left room for.
#include <algorithm>
#include <bit>

#include "renderer/many_lods/gpu_tree.h"
#include "renderer/many_lods/multi_cut.h"
#include "renderer/many_lods/recursive_cut.h"
#include "tests/renderer/many_lods/many_lods_fixture.h"

namespace limen::many_lods {
namespace {

class CutMargins : public gl::GlTest {
 protected:
  static constexpr int kDepth = 11;
  static constexpr uint32_t kViews = 200;
  static std::vector<CutView> anyViews(uint32_t seed, const SphereTree& tree, double epsilonPx = 2.0) {
    std::mt19937 random(seed);
    std::vector<CutView> out;
    for (uint32_t i = 0; i < kViews; ++i) out.push_back(anyView(random, tree, epsilonPx));
    return out;
  }
  static glm::vec4 turned(glm::vec4 axis, const glm::dmat3& by) {
    return {glm::vec3(by * glm::dvec3(glm::vec3(axis))), axis.w};
  }
  /// Each elsewhere by up to `by`, some of them turned by up to as many radians.
  static void move(std::vector<CutView>& views, std::mt19937& random, double by) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (CutView& view : views) {
      const glm::vec3 step(anyDirection(random) * by * unit(random));
      view.eye = glm::vec4(glm::vec3(view.eye) + step, view.eye.w);
      if (random() % 2 == 0) continue;
      // Rodrigues' formula.
      const glm::dvec3 k = anyDirection(random);
      const double angle = by * unit(random), s = std::sin(angle), c = 1.0 - std::cos(angle);
      const glm::dmat3 cross(0.0, k.z, -k.y, -k.z, 0.0, k.x, k.y, -k.x, 0.0);
      const glm::dmat3 rotation = glm::dmat3(1.0) + s * cross + c * (cross * cross);
      view.axisX = turned(view.axisX, rotation);
      view.axisY = turned(view.axisY, rotation);
      view.axisZ = turned(view.axisZ, rotation);
    }
  }
  static bool less(glm::uvec2 a, glm::uvec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }
  static std::vector<glm::uvec2> found(const MultiCut& cut) {
    std::vector<glm::uvec2> list = cut.list();
    std::sort(list.begin(), list.end(), less);
    return list;
  }
  /// From the root, on the CPU.
  static std::vector<glm::uvec2> expected(const std::vector<glm::vec4>& spheres,
                                          const std::vector<CutView>& views) {
    std::vector<glm::uvec2> out;
    for (uint32_t i = 0; i < views.size(); ++i)
      for (const uint32_t node : recursiveCut(spheres, kDepth, views[i])) out.emplace_back(node, i);
    std::sort(out.begin(), out.end(), less);
    return out;
  }
};

TEST_F(CutMargins, CutsEqualTheRecursionHoweverEyesMoveAndTurn) {
  const SphereTree tree = treeOf(bumpyBalls(), kDepth);
  GpuTree onGpu(context(), tree);
  onGpu.keepTravel(context(), false);
  for (const CutOrder order : {CutOrder::Free, CutOrder::Kept}) {
    MultiCut cut(context(), kViews, onGpu.shape(), 1U << 18,
                 IncrementalCuts{.order = order, .margins = true});
    std::mt19937 random(11);
    std::vector<CutView> views = anyViews(1, tree);
    // From far below what rounding leaves certain to anything.
    for (const double by : {0.0, 1e-7, 1e-5, 1e-3, 1e-3, 0.01, 0.01, 0.03, 0.1, 0.1, 0.0, 1.0, 0.02, 1e-4}) {
      move(views, random, by);
      cut.update(onGpu.nodes(), gl::Buffer(views));
      ASSERT_EQ(found(cut), expected(tree.spheres, views)) << "moved by " << by;
    }
  }
}

TEST_F(CutMargins, CutsEqualTheRecursionAsTheTreeMoves) {
  const Triangles of = bumpyBalls();
  const SphereTree tree = treeOf(of, kDepth);
  const gl::Buffer indices(of.triangles);
  GpuTree onGpu(context(), tree);
  onGpu.keepTravel(context(), true);
  MultiCut cut(context(), kViews, onGpu.shape(), 1U << 18, IncrementalCuts{.margins = true});
  std::mt19937 random(12);
  std::vector<CutView> views = anyViews(2, tree);
  double phase = 0.0;
  for (const double by : {0.0, 1e-4, 1e-3, 1e-3, 0.01, 0.05, 0.3, 0.0, 2.0, 1e-3}) {
    phase += by;
    std::vector<glm::vec3> positions;
    for (const glm::dvec3 p : of.positions)
      positions.emplace_back(p.x + 0.3 * std::sin(p.y + phase), p.y * (1.0 + 0.2 * std::sin(phase)),
                             p.z + std::cos(phase));
    onGpu.update(gl::Buffer(positions), indices);
    // Cuts are found in every second frame alone: what the tree does between counts as well.
    if (random() % 2 == 0) onGpu.update(gl::Buffer(positions), indices);
    move(views, random, 0.01 * by);
    cut.update(onGpu.nodes(), gl::Buffer(views));
    ASSERT_EQ(found(cut), expected(onGpu.nodes().read<glm::vec4>(), views)) << "moved by " << by;
  }
}

// But what lies so near a bound that rounding decides.
TEST_F(CutMargins, HardlyAnythingIsTestedWhereNothingMoves) {
  const SphereTree tree = treeOf(bumpyBalls(), kDepth);
  GpuTree onGpu(context(), tree);
  onGpu.keepTravel(context(), false);
  MultiCut cut(context(), kViews, onGpu.shape(), 1U << 18, IncrementalCuts{.margins = true});
  const gl::Buffer views(anyViews(3, tree));
  for (int frame = 0; frame < 3; ++frame) cut.update(onGpu.nodes(), views, true);
  EXPECT_LT(cut.control().tests, cut.control().count / 1000);
}

// The published claim of an order of magnitude, with motion of a thousandth of what views are apart.
TEST_F(CutMargins, ATenthOfTheTestsIsLeftUnderSmallMotion) {
  const SphereTree tree = treeOf(bumpyBalls(), kDepth);
  GpuTree onGpu(context(), tree);
  onGpu.keepTravel(context(), false);
  MultiCut basic(context(), kViews, onGpu.shape(), 1U << 18, BasicCuts{}),
      cut(context(), kViews, onGpu.shape(), 1U << 18, IncrementalCuts{.margins = true});
  std::mt19937 random(13);
  std::vector<CutView> views = anyViews(4, tree);
  uint64_t from = 0, tests = 0;
  for (int frame = 0; frame < 12; ++frame) {
    move(views, random, 0.002);
    const gl::Buffer onGpuViews(views);
    basic.update(onGpu.nodes(), onGpuViews, true);
    cut.update(onGpu.nodes(), onGpuViews, true);
    if (frame < 2) continue;  // from the root, and the first tests of what that has made
    from += basic.control().tests;
    tests += cut.control().tests;
  }
  EXPECT_LT(tests, from / 10);
}

// Views that see more or less than before, or more finely, have moved any distance.
TEST_F(CutMargins, CutsEqualTheRecursionAsViewsChangeTheirSize) {
  const SphereTree tree = treeOf(bumpyBalls(), kDepth);
  GpuTree onGpu(context(), tree);
  onGpu.keepTravel(context(), false);
  MultiCut cut(context(), kViews, onGpu.shape(), 1U << 18, IncrementalCuts{.margins = true});
  std::vector<CutView> views = anyViews(5, tree);
  for (int frame = 0; frame < 6; ++frame) {
    for (uint32_t i = 0; i < kViews; i += 3) {
      views[i].eye.w *= frame % 2 == 0 ? 4.0F : 0.3F;
      if (views[i].axisZ.w == static_cast<float>(kViewPerspective)) {
        views[i].axisX.w *= frame % 2 == 0 ? 1.5F : 0.5F;
        views[i].frustum.x = std::hypot(1.0F, views[i].axisX.w);
      }
      views[i].eye.w = std::max(views[i].eye.w, 1.0F);
    }
    cut.update(onGpu.nodes(), gl::Buffer(views));
    ASSERT_EQ(found(cut), expected(tree.spheres, views)) << "frame " << frame;
  }
}

TEST_F(CutMargins, OverfullListsLoseNothing) {
  const SphereTree tree = treeOf(bumpyBalls(), kDepth);
  GpuTree onGpu(context(), tree);
  onGpu.keepTravel(context(), false);
  for (const CutOrder order : {CutOrder::Free, CutOrder::Kept}) {
    MultiCut cut(context(), kViews, onGpu.shape(), 8000, IncrementalCuts{.order = order, .margins = true});
    std::mt19937 random(14);
    std::vector<CutView> views = anyViews(6, tree);
    for (int frame = 0; frame < 6; ++frame) {
      cut.update(onGpu.nodes(), gl::Buffer(views));
      const CutFaults faults = faultsOf(cut.list(), kViews, kDepth);
      ASSERT_EQ(faults.uncovered + faults.doubled, 0U) << "frame " << frame;
      EXPECT_GT(cut.control().refused, 0U);
      move(views, random, 0.1);
    }
    // Coarse views leave room again.
    views = anyViews(6, tree, 64.0);
    for (int frame = 0; frame < 3; ++frame) cut.update(onGpu.nodes(), gl::Buffer(views));
    const std::vector<glm::uvec2> right = expected(tree.spheres, views);
    ASSERT_LT(right.size(), 8000U);
    EXPECT_EQ(found(cut), right);
  }
}

}  // namespace
}  // namespace limen::many_lods

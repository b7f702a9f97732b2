// SPDX-License-Identifier: BSD-3-Clause
// The tree that the GPU builds: against every triangle in double precision, against the tree built on the CPU
// ray by ray, and on input made to break it.
#include "renderer/ray_tracing/rebuilt_tree.h"

#include "renderer/ray_tracing/rebuilt_tree_bindings.h"
#include "tests/renderer/ray_tracing/trace_fixture.h"

namespace limen::ray_tracing {
namespace {

class Rebuilt : public Trace {
 protected:
  RebuiltTree built(const Soup& soup, int axisBits = 16) {
    RebuiltTree tree(context(), static_cast<uint32_t>(soup.triangles.size()), axisBits);
    tree.build(passes_, gl::Buffer(soup.vertices), gl::Buffer(soup.triangles));
    return tree;
  }

  /// Both trees test a triangle with the same arithmetic, and neither may miss the nearest: distances are the
  /// same to the last bit, and triangles wherever no two are hit at that distance.
  void expectAsOnTheCpu(const RayTree& tree, const Soup& soup, const std::vector<BatchRay>& rays,
                        const char* name) {
    const RayScene scene(context(), soup.vertices, soup.triangles);
    for (const Wanted wanted : {Wanted::ClosestHit, Wanted::AnyHit}) {
      RayBatch expected(context(), scene, rays, wanted), found(context(), tree, rays, wanted);
      expected.trace(), found.trace();
      const std::vector<BatchHit> a = expected.hits(), b = found.hits();
      size_t different = 0, hit = 0, others = 0;
      for (size_t i = 0; i < rays.size(); ++i) {
        const bool isHit = a[i].triangle != kRayNoTriangle;
        hit += isHit;
        different += isHit != (b[i].triangle != kRayNoTriangle);
        if (wanted == Wanted::AnyHit) continue;
        different += !(a[i].t == b[i].t);
        others += a[i].triangle != b[i].triangle;
      }
      EXPECT_EQ(different, 0U) << name;
      EXPECT_GT(hit, rays.size() / 50) << name;
      others_ = others;
    }
  }

  gl::PassList passes_;
  size_t others_ = 0;  ///< rays that met another triangle at the same distance
};

TEST_F(Rebuilt, AgreesWithEveryTriangleInDoublePrecision) {
  for (const int bits : {10, 16, 21}) {
    const Soup three = randomSoup(1, 3, 1.0), soup = randomSoup(3, 500, 0.3), thin = slivers(6, 500);
    expectBruteForce(built(three, bits), three, raysThrough(2, 1000), "three");
    expectBruteForce(built(soup, bits), soup, raysThrough(4, 2000), "soup");
    expectBruteForce(built(soup, bits), soup, raysAlongAxes(5, 2000), "along axes");
    expectBruteForce(built(thin, bits), thin, raysThrough(7, 2000), "slivers");
  }
}

TEST_F(Rebuilt, LeavesOutWhatHasNoAreaOrIsNotFinite) {
  Soup soup = randomSoup(8, 300, 0.4);
  const size_t more = addDegenerate(soup);
  const RebuiltTree tree = built(soup);
  EXPECT_EQ(tree.counts().triangles, soup.triangles.size() - more);
  expectBruteForce(tree, soup, raysThrough(9, 1000), "degenerate");
}

TEST_F(Rebuilt, HitsWhatTheTreeBuiltOnTheCpuHits) {
  // More triangles than a group, a tile of the sort and a level of one group hold; a number that fills none.
  const Soup soup = randomSoup(21, 20011, 0.05);
  const std::vector<BatchRay> rays = raysThrough(22, 20000);
  for (const int bits : {10, 16, 21}) {
    const RebuiltTree tree = built(soup, bits);
    expectAsOnTheCpu(tree, soup, rays, "soup");
    EXPECT_EQ(others_, 0U) << "random triangles do not meet a ray at the same distance";
    const RebuiltTree::Counts counts = tree.counts();
    EXPECT_EQ(counts.triangles, 20011U);
    // Room for nodes: see mostWideNodes().
    EXPECT_LE(counts.nodes, 20011U * 2 / 7 + 2);
    // A tree of 8 children has ceil(log8(20011 / 3)) = 5 levels at the least; one that merely is a tree could
    // have thousands.
    EXPECT_GE(counts.levels, 5);
    EXPECT_LE(counts.levels, 12);
  }
  Soup far = randomSoup(23, 3000, 0.1, {4096.0, -2048.0, 4096.0});
  expectAsOnTheCpu(built(far), far, raysThrough(24, 3000, {4096.0, -2048.0, 4096.0}), "far");
}

TEST_F(Rebuilt, NoRayLeavesAClosedMesh) {
  const Soup ball = sphere(5);
  Dice dice(12);
  std::vector<BatchRay> rays;
  for (const glm::uvec3 t : ball.triangles) {
    const glm::dvec3 a(ball.vertices[t.x]), b(ball.vertices[t.y]);
    for (const glm::dvec3 from : {glm::dvec3(0.0), dice.inCube(0.5)})
      for (const glm::dvec3 to : {a, 0.5 * (a + b)}) rays.push_back({from, 0.0F, to - from, 1e6F});
  }
  for (const BatchRay& ray : raysAlongAxes(13, 3000)) rays.push_back({{}, 0.0F, ray.direction, 1e6F});
  EXPECT_GT(rays.size(), 30000U);
  EXPECT_EQ(leaks(built(ball), rays), 0U);
}

TEST_F(Rebuilt, NoneAndOneAndFew) {
  const std::vector<BatchRay> rays = raysThrough(14, 500);
  for (const Soup& nothing : {Soup{}, [] {
                                Soup soup;
                                addDegenerate(soup);
                                return soup;
                              }()}) {
    const RebuiltTree tree = built(nothing);
    EXPECT_EQ(tree.counts().triangles, 0U);
    RayBatch batch(context(), tree, rays, Wanted::ClosestHit);
    batch.trace();
    for (const BatchHit& hit : batch.hits()) EXPECT_EQ(hit.triangle, kRayNoTriangle);
  }
  for (int count = 1; count <= 12; ++count) {
    const Soup few = randomSoup(static_cast<unsigned>(count), count, 1.5);
    const RebuiltTree tree = built(few);
    EXPECT_EQ(tree.counts().triangles, static_cast<uint32_t>(count));
    expectAsOnTheCpu(tree, few, rays, "few");
  }
}

TEST_F(Rebuilt, EqualCodesAreToldApart) {
  // The same triangle a thousand times, and thousands of triangles about one centre.
  Soup same, around;
  for (int i = 0; i < 1000; ++i) same.add({-1, -1, 0}, {1, -1, 0.1F}, {0, 1, 0});
  Dice dice(31);
  for (int i = 0; i < 3000; ++i) {
    const glm::vec3 low(glm::abs(dice.inCube(1.0)));
    around.add(low, {-low.x, -low.y, low.z}, {low.x, -low.y, -low.z});
  }
  for (const int bits : {10, 16, 21}) {
    expectAsOnTheCpu(built(same, bits), same, raysThrough(32, 1000), "the same");
    EXPECT_LE(built(same, bits).counts().levels, 6);
    expectAsOnTheCpu(built(around, bits), around, raysThrough(33, 1000), "around one centre");
  }
}

/// Triangles ever nearer to a corner: each bit of the codes parts 64 of them, all alike, from those that
/// follow, whose box is smaller than that of any of the 64. Opened by surface alone, each node of the wide
/// tree would spend its eight children on the 64, and there would be a level for each of 42 bits. Coordinates
/// have 20 bits, so that centres are exact.
TEST_F(Rebuilt, ALopsidedTreeFitsTheStack) {
  Soup soup;
  for (int level = 0; level < 14; ++level)
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 at(0.0);
      at[axis] = std::ldexp(1.0, -level);
      const double half = std::ldexp(axis == 0 ? 1.0 : axis == 1 ? 0.625 : 0.40625, 15 - 2 * level);
      for (int i = 0; i < 64; ++i)
        soup.add(at - half, at + half, at + half * glm::dvec3(1.0, i % 2 == 0 ? 1.0 : -1.0, -1.0));
    }
  std::vector<BatchRay> rays = raysThrough(42, 2000);
  for (BatchRay& ray : rays) ray.origin *= 100.0F, ray.direction *= 100.0F;
  for (const int bits : {10, 16, 21}) {
    const RebuiltTree tree = built(soup, bits);
    EXPECT_LE(tree.counts().levels, kRayStack);
    EXPECT_GE(tree.counts().levels, bits == 10 ? 20 : 30) << "the case is not lopsided";
    expectAsOnTheCpu(tree, soup, rays, "lopsided");
  }
}

TEST_F(Rebuilt, HugeAndTinyScenes) {
  for (const float scale : {1e9F, 1e-9F}) {
    Soup soup = randomSoup(51, 800, 0.3);
    for (glm::vec3& vertex : soup.vertices) vertex *= scale;
    std::vector<BatchRay> rays = raysThrough(52, 1000);
    for (BatchRay& ray : rays) ray.origin *= scale, ray.direction *= scale;
    expectAsOnTheCpu(built(soup), soup, rays, "scaled");
  }
}

TEST_F(Rebuilt, ARefittedTreeHitsTheMovedTriangles) {
  const Soup before = randomSoup(61, 5000, 0.08);
  Soup after = before;
  for (size_t i = 0; i < after.vertices.size(); ++i) {
    // Each third triangle moves by as much as the scene is wide.
    if (i / 3 % 3 == 0)
      after.vertices[i] = glm::vec3(after.vertices[i].z, -after.vertices[i].x, after.vertices[i].y);
  }
  const gl::Buffer indices(before.triangles);
  RebuiltTree tree(context(), static_cast<uint32_t>(before.triangles.size()));
  tree.build(passes_, gl::Buffer(before.vertices), indices);
  tree.refit(passes_, gl::Buffer(after.vertices), indices);
  expectAsOnTheCpu(tree, after, raysThrough(62, 5000), "refitted");
  tree.build(passes_, gl::Buffer(after.vertices), indices);
  expectAsOnTheCpu(tree, after, raysThrough(62, 5000), "built again");
}

}  // namespace
}  // namespace limen::ray_tracing

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/sphere_tree.h"

#include "experiments/base/error.h"
#include "renderer/many_lods/gpu_tree.h"
#include "tests/renderer/many_lods/many_lods_fixture.h"

namespace limen::many_lods {
namespace {

constexpr double kPi = std::numbers::pi;

// By construction point i lies in the i-th of n equal strata of the area, so that a run of triangles that
// begins at the first holds its share rounded up or down.
TEST(SurfaceSampling, EveryRunOfTrianglesHasItsShareOfThePoints) {
  const Triangles of = bumpyBalls();
  constexpr uint32_t kCount = 1U << 14;
  const std::vector<SurfaceSample> samples = sampleSurface(of.positions, of.triangles, kCount, 3);
  ASSERT_EQ(samples.size(), kCount);
  std::vector<uint32_t> counts(of.triangles.size());
  for (const SurfaceSample& sample : samples) ++counts[sample.triangle];
  const double area = surfaceArea(of.positions, of.triangles);
  double areaBelow = 0.0, countBelow = 0.0;
  for (size_t i = 0; i < of.triangles.size(); ++i) {
    areaBelow += surfaceArea(of.positions, {of.triangles[i]});
    countBelow += counts[i];
    ASSERT_NEAR(countBelow, kCount * areaBelow / area, 1.0 + 1e-6) << "triangle " << i;
  }
}

// The floor's triangles have thousands of points. Cut into 16 triangles of equal area (by s and t in
// quarters), each has a sixteenth: the discrepancy of a sequence of n points is of the order of log(n)^2 / n,
// far below that of random ones, 1 / sqrt(n); half of the latter is allowed.
TEST(SurfaceSampling, PointsAreEvenWithinATriangle) {
  Triangles of;
  of.add({0, 0, 0}, {3, 0, 0}, {0, 2, 1});
  constexpr uint32_t kCount = 1U << 14;
  const std::vector<SurfaceSample> samples = sampleSurface(of.positions, of.triangles, kCount, 3);
  std::map<int, int> cells;
  glm::dvec2 mean(0.0);
  for (const SurfaceSample& sample : samples) {
    const double s = sample.s(), t = sample.t();
    ASSERT_LE(s + t, 1.0);
    mean += glm::dvec2(s, t) / double(kCount);
    const double a = 4.0 * s, b = 4.0 * t;
    const int i = int(std::min(a, 3.0)), j = int(std::min(b, 3.0));
    ++cells[2 * (i + 4 * j) + (a - i + b - j > 1.0 ? 1 : 0)];
  }
  EXPECT_EQ(cells.size(), 16U);
  for (const auto& [cell, count] : cells)
    EXPECT_NEAR(count, kCount / 16.0, 0.5 * std::sqrt(kCount / 16.0)) << "cell " << cell;
  EXPECT_NEAR(mean.x, 1.0 / 3.0, 1e-3);
  EXPECT_NEAR(mean.y, 1.0 / 3.0, 1e-3);
}

TEST(SurfaceSampling, TrianglesWithoutAreaGetNoPoints) {
  Triangles of;
  of.add({0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  of.add({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  of.add({5, 5, 5}, {5, 5, 5}, {5, 5, 5});
  of.add({0, 0, 0}, {NAN, 0, 0}, {0, 1, 0});
  for (const SurfaceSample& sample : sampleSurface(of.positions, of.triangles, 1000, 1))
    ASSERT_EQ(sample.triangle, 1U);
  of.triangles = {of.triangles[0], of.triangles[2]};
  EXPECT_THROW(sampleSurface(of.positions, of.triangles, 1000, 1), Error);
}

void expectContained(const SphereTree& tree, const std::vector<glm::vec4>& spheres,
                     const std::vector<PackedCone>& cones) {
  for (uint32_t node = 2; node < 2 * tree.leafCount(); ++node) {
    const glm::dvec4 child = spheres[node], parent = spheres[node / 2];
    const double needed = glm::distance(glm::dvec3(child), glm::dvec3(parent)) + child.w;
    // With what the cuts rely on: 16 u of the parent and more.
    ASSERT_LE(needed * (1.0 + 0.9 * kSphereSlack), parent.w) << "node " << node;
    const NormalCone of = unpack(cones[node]), above = unpack(cones[node / 2]);
    if (above.halfAngle >= kPi) continue;
    const double between =
        std::atan2(glm::length(glm::cross(of.axis, above.axis)), glm::dot(of.axis, above.axis));
    ASSERT_LE(between + of.halfAngle, above.halfAngle) << "cone of node " << node;
  }
}

TEST(SphereTrees, ParentsContainChildrenAfterRounding) {
  for (const double shift : {0.0, 1e4}) {
    Triangles of = bumpyBalls();
    for (glm::dvec3& position : of.positions) position += shift;
    const SphereTree tree = treeOf(of, 12);
    expectContained(tree, tree.spheres, tree.cones);
  }
}

// Every leaf is a point of its triangle, and cones contain all normals below.
TEST(SphereTrees, NodesContainTheSurfaceBelow) {
  const Triangles of = bumpyBalls();
  const SphereTree tree = treeOf(of, 11);
  for (uint32_t leaf = 0; leaf < tree.leafCount(); ++leaf) {
    const glm::dvec3 point = positionOf(tree.samples[leaf], of.positions, of.triangles);
    const glm::uvec3 t = of.triangles[tree.samples[leaf].triangle];
    const glm::dvec3 normal = glm::normalize(
        glm::cross(of.positions[t.y] - of.positions[t.x], of.positions[t.z] - of.positions[t.x]));
    for (uint32_t node = tree.leafCount() + leaf; node > 0; node /= 2) {
      const glm::dvec4 sphere = tree.spheres[node];
      ASSERT_LE(glm::distance(point, glm::dvec3(sphere)), sphere.w) << "node " << node;
      const NormalCone cone = unpack(tree.cones[node]);
      const double angle =
          std::atan2(glm::length(glm::cross(normal, cone.axis)), glm::dot(normal, cone.axis));
      ASSERT_TRUE(cone.halfAngle >= kPi || angle <= cone.halfAngle) << "node " << node;
    }
  }
}

// Two balls far apart with as many points each: the median along the axis between them separates them, which
// no other axis does.
TEST(SphereTrees, SplitsWhereVolumesAreLeast) {
  Triangles of;
  for (const double side : {-1.0, 1.0})
    for (int i = 0; i < 100; ++i) {
      const double a = 2.0 * kPi * i / 100.0, b = 2.0 * kPi * (i + 1) / 100.0;
      const glm::dvec3 middle(0.0, 10.0 * side, 0.0);
      of.add(middle, middle + glm::dvec3(std::cos(a), 0.0, std::sin(a)),
             middle + glm::dvec3(std::cos(b), 0.0, std::sin(b)));
    }
  const SphereTree tree = treeOf(of, 8);
  for (const uint32_t node : {2U, 3U}) {
    EXPECT_NEAR(std::abs(tree.spheres[node].y), 10.0, 0.5);
    EXPECT_LT(tree.spheres[node].w, 2.5);
  }
  EXPECT_LT(tree.spheres[2].y, 0.0F);
  EXPECT_GT(tree.spheres[3].y, 0.0F);
}

TEST(SphereTrees, CoincidentPointsAndOpposedNormals) {
  Triangles of;
  of.add({1, 1, 1}, {1 + 1e-12, 1, 1}, {1, 1 + 1e-12, 1});
  of.add({1, 1, 1}, {1, 1 + 1e-12, 1}, {1 + 1e-12, 1, 1});
  const SphereTree tree = treeOf(of, 6);
  for (uint32_t node = 1; node < 2 * tree.leafCount(); ++node) {
    ASSERT_TRUE(std::isfinite(tree.spheres[node].x) && std::isfinite(tree.spheres[node].w));
    ASSERT_GT(tree.spheres[node].w, 0.0F);
  }
  // Half of the points face each way: the root's cone holds both.
  EXPECT_GE(unpack(tree.cones[1]).halfAngle, 0.5 * kPi);
  expectContained(tree, tree.spheres, tree.cones);
}

TEST(SphereTrees, AreTheSameTwice) {
  const Triangles of = bumpyBalls();
  const SphereTree once = treeOf(of, 10), again = treeOf(of, 10);
  EXPECT_EQ(once.spheres, again.spheres);
}

class TreeUpdates : public gl::GlTest {};

// A few roundings of 2^-24 a level, relative to the coordinates' size (30) and in cones the steps of 16 bits.
TEST_F(TreeUpdates, EqualTheMergeOnTheCpu) {
  for (const int depth : {1, 5, 9, 10, 13}) {
    Triangles of = bumpyBalls();
    SphereTree tree = treeOf(of, depth);
    const GpuTree onGpu(context(), tree);
    // Everything bends and twists.
    for (glm::dvec3& p : of.positions) p = {p.x + 0.3 * std::sin(p.y), p.y + 0.01 * p.x * p.x, p.z * 1.2};
    std::vector<glm::vec3> moved;
    for (const glm::dvec3 p : of.positions) moved.emplace_back(p);
    const gl::Buffer positions(moved), indices(of.triangles);
    onGpu.update(positions, indices, true);
    const std::vector<glm::vec4> spheres = onGpu.nodes().read<glm::vec4>();
    const std::vector<PackedCone> cones = onGpu.cones().read<PackedCone>();
    for (uint32_t leaf = 0; leaf < tree.leafCount(); ++leaf) {
      const glm::dvec3 point = positionOf(tree.samples[leaf], of.positions, of.triangles);
      tree.spheres[tree.leafCount() + leaf] = glm::vec4(glm::vec3(point), tree.leafRadius);
    }
    mergeUpwards(tree);
    for (uint32_t node = 1; node < 2 * tree.leafCount(); ++node) {
      ASSERT_LT(glm::distance(glm::vec3(spheres[node]), glm::vec3(tree.spheres[node])), 2e-4F)
          << "depth " << depth << ", node " << node;
      ASSERT_NEAR(spheres[node].w, tree.spheres[node].w, 2e-4F) << "depth " << depth << ", node " << node;
    }
    expectContained(tree, spheres, cones);
  }
}

}  // namespace
}  // namespace limen::many_lods

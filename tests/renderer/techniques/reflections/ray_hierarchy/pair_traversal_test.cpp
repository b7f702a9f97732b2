// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/ray_hierarchy/pair_traversal.h"

#include <epoxy/gl.h>

#include <set>

#include "renderer/frame/mirror_rays.h"
#include "tests/renderer/frame/brute_force.h"
#include "tests/renderer/techniques/technique_fixture.h"

namespace limen::techniques {
namespace {

using HitBits = std::vector<glm::uvec2>;
constexpr uint32_t kNothing = 0xffffffffU;

class PairTraversalTest : public TechniqueTest {
 protected:
  struct Traced {
    HitBits hits;
    Image origins, directions;
    std::vector<uint32_t> ids;
    double tolerance = 0.0;
    PairTraversal::Counts counts;
  };
  static Traced trace(const scene::Scene& scene, glm::ivec2 size, const TraversalSettings& settings,
                      int frames = 1, const std::function<void(const PairTraversal&)>& look = {}) {
    const frame::GpuScene gpuScene(scene);
    frame::Frame frame(context(), scene, gpuScene, size);
    PairTraversal traversal(frame, settings, false);
    Traced out;
    out.tolerance = frame::rayOriginTolerance(gpuScene);
    for (int i = 0; i < frames; ++i) {
      frame.begin();
      const frame::MirrorRays& rays = frame.get<frame::MirrorRays>();
      const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
      traversal.beginFrame(frame);
      traversal.trace(frame, {&rays.origins(), &rays.directions(), &ids}, "1");
      traversal.endFrame();
      out.hits = traversal.hits().read<glm::uvec2>(0, int64_t{size.x} * size.y);
      out.origins = rays.origins().read(), out.directions = rays.directions().read(),
      out.ids = ids.readUint();
      out.counts = traversal.counts();
      if (look) look(traversal);
      frame.end();
      glFinish();
    }
    return out;
  }
  static glm::dvec3 at(const Image& image, size_t pixel) {
    return {image.data[4 * pixel], image.data[4 * pixel + 1], image.data[4 * pixel + 2]};
  }
  static scene::Scene ball(int tessellation) {
    return makeScene("mirrors/ball", {{"tessellation", int64_t{tessellation}}});
  }
};

/// Distances between which a ray's nearest hit lies: all triangles in double precision, once without those
/// that rounding may miss and once with all that it may hit. Sheared coordinates are off by 2^-23 of a
/// vertex' distance from the origin, at most 10 units here, so barycentric coordinates by 1e-6 over a
/// triangle's height, at least 0.02 units: 1e-4 leaves room for two roundings. A plane within twice the
/// tolerance of the origin may be taken to contain it, one within half of it must.
struct Nearest {
  double clearly = 1e300, possibly = 1e300;
};
Nearest nearestOf(const frame::BruteForce& truth, size_t triangles, glm::dvec3 origin, glm::dvec3 direction,
                  uint32_t leaves, double tolerance) {
  Nearest out;
  for (uint32_t i = 0; i < triangles; ++i) {
    if (i == leaves) continue;
    const glm::dvec3 a = truth.corner(i, 0), e1 = truth.corner(i, 1) - a, e2 = truth.corner(i, 2) - a;
    const glm::dvec3 n = glm::cross(e1, e2);
    const double determinant = -glm::dot(n, direction);
    if (determinant == 0.0) continue;
    const glm::dvec3 s = origin - a, q = glm::cross(s, direction);
    const double t = glm::dot(n, s) / determinant, u = glm::dot(e2, q) / determinant,
                 v = -glm::dot(e1, q) / determinant;
    const double inside = std::min({u, v, 1.0 - u - v}), height = std::abs(glm::dot(n, s)) / glm::length(n);
    if (inside >= 1e-4 && height > 2.0 * tolerance && t > 0.0) out.clearly = std::min(out.clearly, t);
    if (inside >= -1e-4 && height > 0.5 * tolerance && t > 0.0) out.possibly = std::min(out.possibly, t);
  }
  return out;
}

/// every ray's nearest hit, found by no means but the triangles themselves.
TEST_F(PairTraversalTest, HitsAreThoseOfAllRaysWithAllTriangles) {
  const scene::Scene scene = ball(6);
  for (const glm::ivec2 size : {glm::ivec2(64, 48), {33, 17}, {5, 64}, {1, 1}, {128, 96}}) {
    const Traced traced = trace(scene, size, {});
    const frame::GpuScene gpuScene(scene);
    const frame::BruteForce truth(scene, gpuScene.anchor());
    int rays = 0, found = 0, ambiguous = 0;
    for (size_t pixel = 0; pixel < traced.hits.size(); ++pixel) {
      if (traced.origins.data[4 * pixel + 3] == 0.0F) continue;
      ++rays;
      const Nearest nearest = nearestOf(truth, scene.mesh.triangles.size(), at(traced.origins, pixel),
                                        at(traced.directions, pixel), traced.ids[pixel], traced.tolerance);
      const glm::uvec2 hit = traced.hits[pixel];
      const double t = hit.y == kNothing ? 1e300 : double(std::bit_cast<float>(hit.x));
      EXPECT_LE(t, nearest.clearly * (1.0 + 1e-5) + 1e-5) << "a hit is missed at " << pixel;
      EXPECT_GE(t, nearest.possibly * (1.0 - 1e-5) - 1e-5) << "nothing is there at " << pixel;
      found += hit.y != kNothing;
      ambiguous += nearest.clearly != nearest.possibly;
    }
    if (size.x < 64) continue;
    EXPECT_GT(rays, 400);
    EXPECT_GT(found, rays / 4);
    EXPECT_LT(ambiguous, rays / 20) << "the test says little";
  }
}

/// Nearest distance, and of equal ones the lowest number: one answer, so that no choice may change a bit.
TEST_F(PairTraversalTest, NoSettingChangesAHit) {
  const scene::Scene scene = ball(6);
  const glm::ivec2 size(61, 45);
  const HitBits truth = trace(scene, size, {}).hits;
  const auto same = [&](const TraversalSettings& settings, const std::string& what) {
    const Traced traced = trace(scene, size, settings);
    EXPECT_EQ(traced.hits, truth) << what;
    return traced.counts;
  };
  for (const int start : {1, 16, 4000}) same({.startNodes = start}, "start " + std::to_string(start));
  for (const int leaf : {2, 4, 8}) {
    same({.leafSide = leaf}, "leaf " + std::to_string(leaf));
    same({.leafSide = leaf, .capacity = 100}, "leaf, short " + std::to_string(leaf));
  }
  same({.merge = BundleMerge::Pairwise}, "pairwise");
  same({.test = BundleTest::Robust}, "robust");
  same({.test = BundleTest::Robust, .startNodes = 1}, "robust from the root");
  for (const compute::ReductionForm form :
       {compute::ReductionForm::Scatter, compute::ReductionForm::Append}) {
    same({.reduction = SeparateReduction{form}}, "separate");
    same({.leafSide = 4, .reduction = SeparateReduction{form}}, "separate, leaf");
    same({.startNodes = 1, .reduction = SeparateReduction{form}}, "separate from the root");
  }
}

/// pairs without room are followed all the same, down to room for one.
TEST_F(PairTraversalTest, NoCapacityLosesAPair) {
  const scene::Scene scene = ball(6);
  const glm::ivec2 size(61, 45);
  const HitBits truth = trace(scene, size, {}).hits;
  // What one level holds, so that the expectations below follow from the scene.
  uint32_t most = 0;
  const HierarchyControl roomy = trace(scene, size, {}).counts.control;
  for (const uint32_t pairs : roomy.pairsAt) most = std::max(most, pairs);
  ASSERT_EQ(roomy.leftEver, 0U);
  ASSERT_GT(most, 5000U);
  for (const int capacity : {1, 100, 1000, 5000, int(most)}) {
    const std::string what = "capacity " + std::to_string(capacity);
    const Traced halved = trace(scene, size, {.capacity = capacity});
    EXPECT_EQ(halved.hits, truth) << what;
    EXPECT_EQ(halved.counts.control.leftEver > 0, capacity < int(most)) << what;
    const Traced fixed = trace(scene, size, {.capacity = capacity, .overflow = FixedBatches{100}});
    EXPECT_EQ(fixed.hits, truth) << what;
    EXPECT_EQ(fixed.counts.batches, int(scene.mesh.triangles.size() + 99) / 100);
    for (const int room : {1, 500, 1000000}) {
      const Traced spilled = trace(scene, size, {.capacity = capacity, .overflow = SpilledPairs{room}});
      EXPECT_EQ(spilled.hits, truth) << what << ", spill " << room;
      if (room < 1000000) continue;
      EXPECT_EQ(spilled.counts.control.leftEver, 0U) << what;
      EXPECT_EQ(spilled.counts.control.spilledEver > 0, capacity < int(most)) << what;
      // At most one more than levels: what waits has come down at least one level each time (section 3.3.4).
      EXPECT_LE(spilled.counts.control.laterBatches, 7U) << what;
    }
    const Traced separate = trace(scene, size, {.capacity = capacity, .reduction = SeparateReduction{}});
    EXPECT_EQ(separate.hits, truth) << what << ", separate";
  }
}

/// batches that overflowed are halved until none does, and the pictures on the way are right.
TEST_F(PairTraversalTest, HalvedBatchesSettle) {
  const scene::Scene scene = ball(6);
  const glm::ivec2 size(61, 45);
  const HitBits truth = trace(scene, size, {}).hits;
  std::vector<uint32_t> left;
  std::vector<int> batches;
  trace(scene, size, {.capacity = 2000}, 8, [&](const PairTraversal& traversal) {
    EXPECT_EQ(traversal.hits().read<glm::uvec2>(0, int64_t{size.x} * size.y), truth);
    left.push_back(traversal.counts().control.leftEver);
    batches.push_back(traversal.counts().batches);
  });
  EXPECT_GT(left.front(), 0U);
  EXPECT_EQ(left.back(), 0U);
  EXPECT_EQ(batches.front(), 1);
  EXPECT_GT(batches.back(), 1);
  EXPECT_LT(batches.back(), 64);
}

/// each ray lies within all nodes above it. Also where sides are no powers of two, or one pixel.
TEST_F(PairTraversalTest, AncestorsContainTheirRays) {
  const scene::Scene scene = ball(6);
  for (const BundleMerge merge : {BundleMerge::Mean, BundleMerge::Pairwise})
    for (const glm::ivec2 size : {glm::ivec2(64, 64), {61, 45}, {1, 37}, {130, 3}}) {
      std::vector<float> nodes;
      std::vector<uint32_t> first;
      const Traced traced =
          trace(scene, size, {.merge = merge, .startNodes = 1}, 1, [&](const PairTraversal& t) {
            nodes = t.nodes().read<float>();
            for (uint32_t level = 0; level <= t.startLevel(); ++level) first.push_back(t.levelFirst(level));
            EXPECT_EQ(t.levelSize(t.startLevel()), glm::ivec2(1));
          });
      for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
          const size_t pixel = size_t(y) * size_t(size.x) + size_t(x);
          if (traced.origins.data[4 * pixel + 3] == 0.0F) {
            EXPECT_LT(nodes[8 * pixel + 3], 0.0F);
            continue;
          }
          const glm::dvec3 origin = at(traced.origins, pixel),
                           way = glm::normalize(at(traced.directions, pixel));
          for (size_t level = 0; level < first.size(); ++level) {
            const int wide = (size.x + (1 << level) - 1) >> level;
            const size_t index = first[level] + size_t((y >> level) * wide + (x >> level));
            const float* node = &nodes[8 * index];
            const glm::dvec3 centre(node[0], node[1], node[2]), axis(node[4], node[5], node[6]);
            ASSERT_LE(glm::length(origin - centre), double(node[3])) << "level " << level;
            if (node[7] >= 1000.0F) continue;
            const double angle = std::atan2(glm::length(glm::cross(axis, way)), glm::dot(axis, way));
            ASSERT_LE(angle, 2.0 * std::atan(double(node[7]))) << "level " << level;
          }
        }
    }
}

/// what is left at the rays are the triangles whose spheres they meet, and no more than the test's
/// rounding allows (2e-6 of the distance, and as much of half the angle of a single ray: 6e-5 at 10 units, on
/// spheres of 0.1 and more: 0.12 % of what they cover).
TEST_F(PairTraversalTest, PairsThatRemainAreSpheresThatRaysMeet) {
  const scene::Scene scene = ball(4);
  const glm::ivec2 size(40, 30);
  const frame::GpuScene gpuScene(scene);
  const frame::BruteForce truth(scene, gpuScene.anchor());
  std::vector<glm::uvec2> pairs;
  const Traced traced =
      trace(scene, size, {}, 1, [&](const PairTraversal& traversal) { pairs = traversal.lastPairs(); });
  std::set<std::pair<uint32_t, uint32_t>> kept;
  for (const glm::uvec2& pair : pairs)
    kept.emplace((pair.x >> 14) * uint32_t(size.x) + (pair.x & 0x3fffU), pair.y);
  EXPECT_EQ(kept.size(), pairs.size()) << "a pair came twice";
  size_t expected = 0;
  for (size_t pixel = 0; pixel < traced.hits.size(); ++pixel) {
    if (traced.origins.data[4 * pixel + 3] == 0.0F) continue;
    const glm::dvec3 origin = at(traced.origins, pixel), way = glm::normalize(at(traced.directions, pixel));
    for (uint32_t i = 0; i < scene.mesh.triangles.size(); ++i) {
      // The smallest sphere: around the longest edge if the third corner is within, else around all three.
      const glm::dvec3 p[3] = {truth.corner(i, 0), truth.corner(i, 1), truth.corner(i, 2)};
      glm::dvec3 centre;
      double radius = -1.0;
      for (int k = 0; k < 3; ++k) {
        const glm::dvec3 middle = 0.5 * (p[k] + p[(k + 1) % 3]);
        const double half = 0.5 * glm::length(p[k] - p[(k + 1) % 3]);
        if (glm::length(p[(k + 2) % 3] - middle) <= half * (1.0 + 1e-9)) centre = middle, radius = half;
      }
      if (radius < 0.0) {
        const glm::dvec3 a = p[1] - p[0], b = p[2] - p[0], n = glm::cross(a, b);
        const glm::dvec3 offset =
            (glm::dot(a, a) * glm::cross(b, n) + glm::dot(b, b) * glm::cross(n, a)) / (2.0 * glm::dot(n, n));
        centre = p[0] + offset, radius = glm::length(offset);
      }
      const glm::dvec3 v = centre - origin;
      const double along = glm::dot(v, way);
      const double apart = along > 0.0 ? glm::length(v - along * way) : glm::length(v);
      if (apart > radius * (1.0 - 1e-6)) continue;
      ++expected;
      EXPECT_TRUE(kept.count({uint32_t(pixel), i})) << "pixel " << pixel << " and triangle " << i;
    }
  }
  EXPECT_GT(expected, 1000U);
  EXPECT_LE(double(kept.size()), 1.0012 * double(expected) + 5.0);
}

/// E3: equation 3.1 as printed loses what wide nodes should keep; from the root, which sees nearly all
/// directions, that is everything.
TEST_F(PairTraversalTest, PrintedFormLosesHits) {
  const scene::Scene scene = ball(6);
  const glm::ivec2 size(61, 45);
  const HitBits truth = trace(scene, size, {}).hits;
  const HitBits printed = trace(scene, size, {.test = BundleTest::Printed, .startNodes = 1}).hits;
  int hits = 0, lost = 0;
  for (size_t i = 0; i < truth.size(); ++i) {
    if (truth[i].y == kNothing || truth[i].y == 0U) continue;
    ++hits;
    lost += printed[i] != truth[i];
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(lost, hits / 2);
}

}  // namespace
}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
// Rays on the GPU against every triangle in double precision, and against closed meshes that must not leak.
#include "tests/renderer/ray_tracing/trace_fixture.h"

namespace limen::ray_tracing {
namespace {

TEST_F(Trace, AgreesWithEveryTriangleInDoublePrecision) {
  expectBruteForce(randomSoup(1, 3, 1.0), raysThrough(2, 1000), "three");
  expectBruteForce(randomSoup(3, 500, 0.3), raysThrough(4, 2000), "soup");
  expectBruteForce(randomSoup(3, 500, 0.3), raysAlongAxes(5, 2000), "along axes");
  expectBruteForce(slivers(6, 500), raysThrough(7, 2000), "slivers");
  Soup degenerate = randomSoup(8, 300, 0.4);
  addDegenerate(degenerate);
  expectBruteForce(degenerate, raysThrough(9, 1000), "degenerate");
}

TEST_F(Trace, AgreesFarFromTheOrigin) {
  // 4096 units away a coordinate is a multiple of 2^-11.
  const glm::dvec3 far(4096.0, -2048.0, 4096.0);
  expectBruteForce(randomSoup(10, 500, 0.3, far), raysThrough(11, 1000, far), "far");
}

TEST_F(Trace, NoRayLeavesAClosedMesh) {
  const Soup ball = sphere(5);
  Dice dice(12);
  std::vector<BatchRay> rays;
  const auto add = [&](glm::dvec3 from, glm::dvec3 to) { rays.push_back({from, 0.0F, to - from, 1e6F}); };
  for (const glm::uvec3 t : ball.triangles) {
    const glm::dvec3 a(ball.vertices[t.x]), b(ball.vertices[t.y]);
    for (const glm::dvec3 from : {glm::dvec3(0.0), dice.inCube(0.5), dice.inCube(0.1)}) {
      add(from, a);
      add(from, 0.5 * (a + b));
      add(from, glm::mix(a, b, dice.in(0.0, 1.0)));
    }
  }
  for (const BatchRay& ray : raysAlongAxes(13, 3000)) rays.push_back({{}, 0.0F, ray.direction, 1e6F});
  EXPECT_GT(rays.size(), 70000U);
  EXPECT_EQ(leaks(ball, rays), 0U);
}

TEST_F(Trace, NoRayPassesBetweenTheTrianglesOfAGrid) {
  // Edges along the axes: rays in the planes of boxes, through edges and vertices.
  Soup grid;
  constexpr int kSide = 16;
  for (int y = 0; y <= kSide; ++y)
    for (int x = 0; x <= kSide; ++x) grid.vertices.emplace_back(x, y, 0.0F);
  for (uint32_t y = 0; y < kSide; ++y)
    for (uint32_t x = 0; x < kSide; ++x) {
      const uint32_t at = y * (kSide + 1) + x;
      grid.triangles.emplace_back(at, at + 1, at + kSide + 1);
      grid.triangles.emplace_back(at + 1, at + kSide + 2, at + kSide + 1);
    }
  std::vector<BatchRay> rays;
  for (int y = 0; y <= 4 * kSide; ++y)
    for (int x = 0; x <= 4 * kSide; ++x)
      for (const float z : {1.0F, -1.0F}) {
        const glm::vec3 at(0.25F * float(x), 0.25F * float(y), 0.0F);
        rays.push_back({at + glm::vec3(0, 0, z), 0.0F, {0, 0, -z}, 2.0F});
        if (y == 4 * kSide) continue;  // the next ray leaves over the rim
        rays.push_back({at + glm::vec3(0, 0, z), 0.0F, {-0.0F, 1e-40F, -z}, 2.0F});
      }
  EXPECT_EQ(leaks(grid, rays), 0U);
}

TEST_F(Trace, DistancesAndWeightsDescribeTheHit) {
  Soup soup;
  soup.add({0, 0, 2}, {4, 0, 2}, {0, 4, 2});
  soup.add({0, 0, 5}, {4, 0, 5}, {0, 4, 5});
  const RayScene scene(context(), soup.vertices, soup.triangles);
  const std::vector<BatchRay> rays = {
      {{1, 2, 0}, 0.0F, {0, 0, 1}, 10.0F}, {{1, 2, 0}, 3.0F, {0, 0, 1}, 10.0F},
      {{1, 2, 0}, 0.0F, {0, 0, 1}, 1.5F},  {{1, 2, 0}, 0.0F, {0, 0, 4}, 0.5F},
      {{1, 2, 0}, 2.0F, {0, 0, 1}, 4.0F},  {{1, 2, 3}, 0.0F, {0, 0, 0}, 4.0F},
      {{1, 2, 9}, 0.0F, {0, 0, -2}, 10.0F}};
  RayBatch batch(context(), scene, rays, Wanted::ClosestHit);
  batch.trace();
  const std::vector<BatchHit> hits = batch.hits();
  EXPECT_EQ(hits[0].triangle, 0U);
  EXPECT_FLOAT_EQ(hits[0].t, 2.0F);
  EXPECT_FLOAT_EQ(hits[0].u, 0.25F);
  EXPECT_FLOAT_EQ(hits[0].v, 0.5F);
  EXPECT_EQ(hits[1].triangle, 1U);
  EXPECT_EQ(hits[2].triangle, kRayNoTriangle);
  EXPECT_EQ(hits[3].triangle, 0U) << "the far end is included";
  EXPECT_EQ(hits[4].triangle, kRayNoTriangle) << "the near end is not";
  EXPECT_EQ(hits[5].triangle, kRayNoTriangle) << "no direction";
  EXPECT_EQ(hits[6].triangle, 1U);
  EXPECT_FLOAT_EQ(hits[6].t, 2.0F);
}

TEST_F(Trace, ARayThatTakesTooLongForASoftwareRendererHasNoResult) {
  // Cards side by side, half of each box empty; the ray passes through all the empty halves.
  Soup cards;
  for (int i = 0; i < 150000; ++i) {
    const auto z = 1e-5F * static_cast<float>(i);
    cards.add({0, 0, z}, {1, 0, z}, {0, 1, z});
  }
  const RayScene scene(context(), cards.vertices, cards.triangles);
  const std::vector<BatchRay> rays = {{{0.7F, 0.7F, -1}, 0.0F, {0, 0, 1}, 10.0F},
                                      {{0.2F, 0.2F, -1}, 0.0F, {0, 0, 1}, 10.0F}};
  RayBatch batch(context(), scene, rays, Wanted::ClosestHit);
  batch.trace();
  const std::vector<BatchHit> hits = batch.hits();
  if (context().device().software) {
    EXPECT_TRUE(std::isnan(hits[0].t)) << hits[0].t << ", triangle " << hits[0].triangle;
  } else {
    EXPECT_EQ(hits[0].triangle, kRayNoTriangle);
    EXPECT_EQ(hits[0].t, 10.0F);
  }
  EXPECT_EQ(hits[1].triangle, 0U);
}

TEST_F(Trace, ASceneWithoutTrianglesIsNeverHit) {
  const RayScene scene(context(), {}, {});
  RayBatch batch(context(), scene, raysThrough(14, 10), Wanted::ClosestHit);
  batch.trace();
  for (const BatchHit& hit : batch.hits()) EXPECT_EQ(hit.triangle, kRayNoTriangle);
}

}  // namespace
}  // namespace limen::ray_tracing

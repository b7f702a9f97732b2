// SPDX-License-Identifier: BSD-3-Clause
// Rays on the GPU against every triangle in double precision, and against closed meshes that must not leak.
#include <algorithm>
#include <cmath>

#include "renderer/ray_tracing/ray_batch.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/renderer/ray_tracing/soups.h"

namespace limen::ray_tracing {
namespace {

/// How a ray passes a triangle, in double precision.
struct Passage {
  double t = 0.0;
  /// Distance between the ray and the triangle's outline where it passes the plane, as a share of the largest
  /// coordinate difference involved; negative: outside.
  double inside = -1.0;
};

Passage passage(const BatchRay& ray, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
  const glm::dvec3 o(ray.origin), d(ray.direction), n = glm::cross(b - a, c - a);
  Passage out;
  out.t = glm::dot(n, a - o) / glm::dot(n, d);
  const glm::dvec3 at = o + out.t * d;
  double distance = 1e300;
  for (const auto& [from, to] : {std::pair(a, b), {b, c}, {c, a}}) {
    // From the ray (a line) to the edge's line; the plane holds neither.
    const glm::dvec3 across = glm::cross(to - from, d);
    const double gap = std::abs(glm::dot(from - o, across)) / glm::length(across);
    const double side = glm::dot(glm::cross(to - from, at - from), n);
    distance = std::min(distance, side >= 0.0 ? gap : -gap);
  }
  double reach = 0.0;
  for (const glm::dvec3 corner : {a, b, c})
    for (int i = 0; i < 3; ++i) reach = std::max(reach, std::abs(corner[i] - o[i]));
  out.inside = distance / reach;
  return out;
}

class Trace : public gl::GlTest {
 protected:
  /// Whatever the double-precision test hits by more than the rounding of the sheared coordinates must be
  /// hit, whatever it misses by as much must be missed. Coordinates relative to the origin are rounded (2^-24
  /// of the reach), sheared (2 roundings, by a factor up to 1 twice the reach) and multiplied; 2^-20 is some
  /// four times that. The direction of a sliver's edge cannot be worse than that of its ends.
  static constexpr double kTie = 0x1p-20;

  void expectBruteForce(const Soup& soup, const std::vector<BatchRay>& rays, const char* name) {
    const RayScene scene(context(), soup.vertices, soup.triangles);
    RayBatch closest(context(), scene, rays, Wanted::ClosestHit), any(context(), scene, rays, Wanted::AnyHit);
    closest.trace(), any.trace();
    const std::vector<BatchHit> first = closest.hits(), some = any.hits();
    size_t hit = 0, wrong = 0, ties = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
      double nearest = 1e300, nearestSure = 1e300;
      for (const glm::uvec3 t : soup.triangles) {
        const glm::dvec3 a(soup.vertices[t.x]), b(soup.vertices[t.y]), c(soup.vertices[t.z]);
        const Passage at = passage(rays[i], a, b, c);
        if (!(at.inside >= -kTie) || !(at.t > rays[i].near * (1.0 - 1e-5)) ||
            !(at.t <= rays[i].far * (1.0 + 1e-5)))
          continue;
        nearest = std::min(nearest, at.t);
        if (at.inside >= kTie && at.t > rays[i].near * (1.0 + 1e-5) && at.t <= rays[i].far * (1.0 - 1e-5))
          nearestSure = std::min(nearestSure, at.t);
      }
      const bool found = first[i].triangle != kRayNoTriangle;
      hit += found, ties += nearest != nearestSure;
      // Seen edge-on a distance is less exact; the reach of the soup over a glancing angle of 1e-3 and more.
      const double slack = 1e-4 * std::max(1.0, std::abs(double(first[i].t)));
      wrong += found ? first[i].t < nearest - slack || first[i].t > nearestSure + slack : nearestSure < 1e300;
      wrong += (some[i].triangle != kRayNoTriangle) != found;
    }
    EXPECT_EQ(wrong, 0U) << name;
    EXPECT_GT(hit, rays.size() / 50) << name;
    EXPECT_LT(ties, rays.size() / 20) << name;
  }

  size_t leaks(const Soup& closed, const std::vector<BatchRay>& rays) {
    const RayScene scene(context(), closed.vertices, closed.triangles);
    size_t out = 0;
    for (const Wanted wanted : {Wanted::AnyHit, Wanted::ClosestHit}) {
      RayBatch batch(context(), scene, rays, wanted);
      batch.trace();
      for (const BatchHit& hit : batch.hits()) out += hit.triangle == kRayNoTriangle || std::isnan(hit.t);
    }
    return out;
  }
};

std::vector<BatchRay> raysThrough(unsigned seed, int count, glm::dvec3 middle = {}) {
  Dice dice(seed);
  std::vector<BatchRay> rays;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 from = middle + 3.0 * dice.direction(), to = middle + dice.inCube(1.0);
    rays.push_back({from, 0.0F, to - from, static_cast<float>(dice.in(0.3, 3.0))});
  }
  return rays;
}

/// Along an axis, both ways, zeros of both signs and a denormal number among the components.
std::vector<BatchRay> raysAlongAxes(unsigned seed, int count) {
  Dice dice(seed);
  std::vector<BatchRay> rays;
  for (int i = 0; i < count; ++i) {
    glm::vec3 direction = i % 7 == 0 ? glm::vec3(1e-40F) : i % 2 == 0 ? glm::vec3(0.0F) : glm::vec3(-0.0F);
    direction[i % 3] = i % 5 < 2 ? 1.0F : -1.0F;
    glm::vec3 from(dice.inCube(1.0));
    from[i % 3] = -3.0F * direction[i % 3];
    rays.push_back({from, 0.0F, direction, 10.0F});
  }
  return rays;
}

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

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/ray_roots.h"

#include <gtest/gtest.h>

#include "renderer/scene/curved/teapot.h"
#include "renderer/surfaces/patch_builder.h"
#include "renderer/surfaces/patch_convert.h"
#include "renderer/surfaces/patch_tracer.h"
#include "renderer/surfaces/pn_triangles.h"
#include "renderer/surfaces/quadrics.h"
#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::surfaces {
namespace {

using glm::dvec3;
using scene::Random;

constexpr double kTolerance = 1e-7;

/// Random bicubic patches and cubic triangles, strongly folded.
PatchSet foldedPatches(int count) {
  Random random(11);
  PatchSet set;
  for (int i = 0; i < count; ++i) {
    std::vector<glm::dvec4> points;
    for (int p = 0; p < (i % 2 ? 10 : 16); ++p) {
      const double weight = i % 4 == 2 ? std::exp(random.uniform(-1.5, 1.5)) : 1.0;
      points.push_back(
          weighted({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}, weight));
    }
    if (i % 2) {
      addTriangle(set, 3, points);
    } else {
      addRectangle(set, 3, 3, points);
    }
  }
  return set;
}

bool contains(const std::vector<RayRoot>& roots, double t, double within) {
  return std::any_of(roots.begin(), roots.end(),
                     [&](const RayRoot& root) { return std::abs(root.t - t) < within; });
}

std::vector<RayRoot> clipped(const PatchSet& set, const Patch& patch, const Ray& ray,
                             RootCounts* counts = nullptr) {
  if (patch.domain == Domain::Rectangle) return clippedRoots(onRay(set, patch, ray), kTolerance, {}, counts);
  PatchSet rectangle;
  const Patch converted = triangleAsRectangle(set, patch, rectangle);
  return clippedRoots(onRay(rectangle, converted, ray), kTolerance, {}, counts);
}

/// Rays at chosen points of the surface: that root is known without any root finder.
TEST(RayRoots, FindThePointThatTheRayWasAimedAt) {
  Random random(12);
  const PatchSet set = foldedPatches(40);
  size_t both = 0, several = 0;
  for (const Patch& patch : set.patches)
    for (int trial = 0; trial < 20; ++trial) {
      double u = random.uniform(0, 1), v = random.uniform(0, 1);
      if (patch.domain == Domain::Triangle && u + v > 1.0) u = 1.0 - u, v = 1.0 - v;
      const dvec3 target = evaluate(set, patch, domainPoint(patch.domain, u, v), Order::Position).p;
      const dvec3 origin = 5.0 * random.direction();
      const double t = glm::length(target - origin);
      const Ray ray{origin, (target - origin) / t};
      const std::vector<RayRoot> hulls = hullRoots(onRay(set, patch, ray), kTolerance);
      const std::vector<RayRoot> clips = clipped(set, patch, ray);
      const std::vector<RayRoot> intervals = intervalRoots(onRay(set, patch, ray), kTolerance);
      ASSERT_TRUE(contains(intervals, t, 1e-5)) << u << " " << v;
      for (const RayRoot& root : hulls) EXPECT_TRUE(contains(intervals, root.t, 1e-3));
      for (const RayRoot& root : intervals) EXPECT_TRUE(contains(hulls, root.t, 1e-3));
      ASSERT_TRUE(contains(hulls, t, 1e-5)) << u << " " << v;
      ASSERT_TRUE(contains(clips, t, 1e-5)) << u << " " << v;
      both += hulls.size() == clips.size();
      several += hulls.size() > 1;
      for (const RayRoot& root : clips) EXPECT_TRUE(contains(hulls, root.t, 1e-5));
      for (const RayRoot& root : hulls) {
        const dvec3 p = evaluate(set, patch, root.at, Order::Position).p;
        EXPECT_LT(glm::length(p - (ray.origin + root.t * ray.direction)), 2.0 * kTolerance);
        EXPECT_TRUE(contains(clips, root.t, 1e-3));
      }
    }
  EXPECT_GE(both, 790U);     // a ray that grazes the surface may be reported several times
  EXPECT_GT(several, 150U);  // folded as they are
}

/// Rays at corners, at sides and at places in the middle of boxes, where roots are lost first. Parameters are
/// exact in binary.
TEST(RayRoots, OnSidesAndCornersAreNotMissedByIntervals) {
  Random random(15);
  const PatchSet set = foldedPatches(40);
  constexpr double kPlaces[] = {0.0, 0.125, 0.25, 0.5, 0.75, 1.0};
  int64_t steps = 0, unproven = 0, rays = 0;
  for (const Patch& patch : set.patches)
    for (const double u : kPlaces)
      for (const double v : kPlaces) {
        if (patch.domain == Domain::Triangle && u + v > 1.0) continue;
        const dvec3 target = evaluate(set, patch, domainPoint(patch.domain, u, v), Order::Position).p;
        const dvec3 origin = 5.0 * random.direction();
        const double t = glm::length(target - origin);
        RootCounts counts;
        // No tolerance: what is reported is proven.
        EXPECT_TRUE(contains(
            intervalRoots(onRay(set, patch, {origin, (target - origin) / t}), 1e-13, &counts), t, 1e-9))
            << u << " " << v;
        steps += counts.steps, unproven += counts.unproven, ++rays;
      }
  EXPECT_LE(unproven, rays / 50);
  EXPECT_LT(steps, 200 * rays);
}

/// A paraboloid over a plane, z = u^2 + v^2 moved by a constant: rays within it touch the surface, cross it
/// twice, or miss it by a hair.
TEST(RayRoots, OfIntervalsTellCrossingFromMissing) {
  for (const double height : {1e-3, 1e-6, 1e-9, -1e-9, -1e-6, -1e-3}) {
    PatchSet set;
    std::vector<glm::dvec4> points;
    for (int j = 0; j <= 2; ++j)
      for (int i = 0; i <= 2; ++i) {
        // x^2 on [-1, 1] has the Bernstein coefficients 1, -1, 1.
        const double square[] = {1.0, -1.0, 1.0};
        points.emplace_back(i - 1.0, j - 1.0, square[i] + square[j] - height, 1.0);
      }
    addRectangle(set, 2, 2, points);
    const std::vector<RayRoot> roots =
        intervalRoots(onRay(set, set.patches[0], {{-3.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}), 1e-13);
    ASSERT_EQ(roots.size(), height > 0.0 ? 2U : 0U) << height;
    if (height < 0.0) continue;
    EXPECT_NEAR(roots[0].t, 3.0 - std::sqrt(height), 1e-9);
    EXPECT_NEAR(roots[1].t, 3.0 + std::sqrt(height), 1e-9);
  }
}

TEST(RayRoots, OfTheSphereAreThoseOfItsEquation) {
  const PatchSet sphere = unitSphere();
  for (const RootFinder finder : {RootFinder::Clipping, RootFinder::Hulls, RootFinder::Intervals}) {
    const PatchTracer tracer(sphere, finder);
    Random random(13);
    RootCounts counts;
    for (int trial = 0; trial < 3000; ++trial) {
      const dvec3 origin = 3.0 * random.direction(), target = 1.2 * random.uniform(0, 1) * random.direction();
      const dvec3 d = glm::normalize(target - origin);
      const double b = glm::dot(origin, d), q = b * b - glm::dot(origin, origin) + 1.0;
      if (std::abs(q) < 1e-6) continue;
      const auto hit = tracer.nearest({origin, d}, kTolerance, &counts);
      ASSERT_EQ(hit.has_value(), q > 0.0) << toText(finder) << " " << trial;
      if (hit) {
        ASSERT_NEAR(hit->t, -b - std::sqrt(q), 1e-6);
      }
    }
    EXPECT_GT(counts.steps, 0);
  }
}

/// Rays at the sphere's poles, where each octant has a collapsed side: the same place at all parameters.
TEST(RayRoots, AtACollapsedSideAreReportedOnce) {
  const PatchSet sphere = unitSphere();
  Random random(14);
  RootCounts counts;
  for (int trial = 0; trial < 200; ++trial) {
    const dvec3 pole(0.0, trial % 2 ? 1.0 : -1.0, 0.0);
    dvec3 origin = 3.0 * random.direction();
    origin.y =
        std::copysign(std::max(std::abs(origin.y), 2.0), pole.y);  // above the plane that touches the pole
    const double t = glm::length(pole - origin);
    const Ray ray{origin, (pole - origin) / t};
    int reports = 0;
    for (const Patch& patch : sphere.patches)
      for (const RayRoot& root : clippedRoots(onRay(sphere, patch, ray), kTolerance, {}, &counts))
        reports += std::abs(root.t - t) < 1e-5;
    EXPECT_GE(reports, 1);
    EXPECT_LE(reports, 4);  // of each octant around the pole
  }
  EXPECT_GT(counts.duplicates, 0);  // found several times, as the literature warns, and dropped
}

TEST(RayRoots, OfTheTeapotAgreeBetweenTheMethods) {
  const PatchSet teapot = scene::teapot();
  const PatchTracer clips(teapot, RootFinder::Clipping), hulls(teapot, RootFinder::Hulls),
      intervals(teapot, RootFinder::Intervals);
  int hits = 0, differ = 0;
  const dvec3 origin(4.0, 5.0, 7.0);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 80; ++x) {
      const dvec3 target(-4.0 + 0.1 * x, 3.5 - 0.07 * y, 0.13 * std::sin(x * 0.7 + y));
      const Ray ray{origin, glm::normalize(target - origin)};
      const auto a = clips.nearest(ray, 1e-6);
      for (const auto& b : {hulls.nearest(ray, 1e-6), intervals.nearest(ray, 1e-6)})
        differ += a.has_value() != b.has_value() || (a && std::abs(a->t - b->t) > 1e-4);
      hits += a.has_value();
    }
  EXPECT_GT(hits, 1500);
  EXPECT_EQ(differ, 0);
}

}  // namespace
}  // namespace limen::surfaces

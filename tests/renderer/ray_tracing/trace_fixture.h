// SPDX-License-Identifier: BSD-3-Clause
// Rays on the GPU against every triangle in double precision.
#pragma once

#include <algorithm>
#include <cmath>

#include "renderer/ray_tracing/ray_batch.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "tests/renderer/gl/gl_fixture.h"
#include "tests/renderer/ray_tracing/soups.h"

namespace limen::ray_tracing {

/// How a ray passes a triangle, in double precision.
struct Passage {
  double t = 0.0;
  /// Distance between the ray and the triangle's outline where it passes the plane, as a share of the largest
  /// coordinate difference involved; negative: outside.
  double inside = -1.0;
};

inline Passage passage(const BatchRay& ray, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
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
    expectBruteForce(RayScene(context(), soup.vertices, soup.triangles), soup, rays, name);
  }

  void expectBruteForce(const RayTree& tree, const Soup& soup, const std::vector<BatchRay>& rays,
                        const char* name) {
    RayBatch closest(context(), tree, rays, Wanted::ClosestHit), any(context(), tree, rays, Wanted::AnyHit);
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
    return leaks(RayScene(context(), closed.vertices, closed.triangles), rays);
  }

  size_t leaks(const RayTree& tree, const std::vector<BatchRay>& rays) {
    size_t out = 0;
    for (const Wanted wanted : {Wanted::AnyHit, Wanted::ClosestHit}) {
      RayBatch batch(context(), tree, rays, wanted);
      batch.trace();
      for (const BatchHit& hit : batch.hits()) out += hit.triangle == kRayNoTriangle || std::isnan(hit.t);
    }
    return out;
  }
};

inline std::vector<BatchRay> raysThrough(unsigned seed, int count, glm::dvec3 middle = {}) {
  Dice dice(seed);
  std::vector<BatchRay> rays;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 from = middle + 3.0 * dice.direction(), to = middle + dice.inCube(1.0);
    rays.push_back({from, 0.0F, to - from, static_cast<float>(dice.in(0.3, 3.0))});
  }
  return rays;
}

/// Along an axis, both ways, zeros of both signs and a denormal number among the components.
inline std::vector<BatchRay> raysAlongAxes(unsigned seed, int count) {
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

}  // namespace limen::ray_tracing

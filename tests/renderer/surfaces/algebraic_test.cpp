// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/algebraic.h"

#include <gtest/gtest.h>

#include "tests/renderer/scene/scene_fixtures.h"

namespace limen::surfaces {
namespace {

using glm::dvec3;
using scene::Random;

/// The polynomials as the thesis prints them, in the long format.
long double printed(Algebraic surface, const dvec3& at) {
  const long double x = at.x, y = at.y, z = at.z, r2 = x * x + y * y + z * z;
  const long double t = (1.0L + std::sqrt(5.0L)) / 2.0L, t4 = t * t * t * t;
  switch (surface) {
    case Algebraic::Sphere:
      return r2 - 1;
    case Algebraic::Hyperboloid:
      return x * x - y * y + z * z - 0.25L;
    case Algebraic::Torus:
      return (r2 + 4 - 1) * (r2 + 4 - 1) - 16 * (x * x + y * y);
    case Algebraic::Goursat:
      return x * x * x * x + y * y * y * y + z * z * z * z - 2 * r2 - 1;
    case Algebraic::Heart: {
      const long double a = x * x + 9 * y * y / 4 + z * z - 1;
      return a * a * a - x * x * z * z * z - 9 * y * y * z * z * z / 80;
    }
    case Algebraic::BarthDecic:
      break;
  }
  return 8 * (x * x - t4 * y * y) * (y * y - t4 * z * z) * (z * z - t4 * x * x) *
             (x * x * x * x + y * y * y * y + z * z * z * z - 2 * x * x * y * y - 2 * x * x * z * z -
              2 * y * y * z * z) +
         (3 + 5 * t) * (r2 - 1) * (r2 - 1) * (r2 - (2 - t)) * (r2 - (2 - t));
}

const Algebraic kAll[] = {Algebraic::Sphere,  Algebraic::Hyperboloid, Algebraic::Torus,
                          Algebraic::Goursat, Algebraic::Heart,       Algebraic::BarthDecic};

TEST(Algebraic, ValuesAreThoseOfThePrintedPolynomials) {
  Random random(21);
  for (const Algebraic surface : kAll)
    for (int trial = 0; trial < 1000; ++trial) {
      const dvec3 at(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2, 2));
      const auto expected = static_cast<double>(printed(surface, at));
      EXPECT_NEAR(valueOf(surface, at), expected, 1e-11 * (1.0 + std::abs(expected)) * 100)
          << toText(surface);
    }
}

/// The first change of sign along the ray, looked for in many small steps: no root finder at all. A pair of
/// roots within a step is not seen.
TEST(Algebraic, TheFirstRootIsTheFirstChangeOfSign) {
  Random random(22);
  constexpr int kSteps = 4000;
  for (const Algebraic surface : kAll) {
    int hits = 0;
    for (int trial = 0; trial < 150; ++trial) {
      const double radius = radiusOf(surface);
      const dvec3 origin = 2.0 * radius * random.direction(), target = 0.7 * radius * random.direction();
      const Ray ray{origin, glm::normalize(target - origin)};
      const double from = 0.2 * radius, to = 3.5 * radius, step = (to - from) / kSteps;
      const auto found = firstRoot(surface, ray, from, to);
      double expected = -1.0;
      long double last = printed(surface, origin + from * ray.direction);
      for (int i = 1; i <= kSteps && expected < 0.0; ++i) {
        const long double next = printed(surface, origin + (from + i * step) * ray.direction);
        if ((last > 0) != (next > 0)) expected = from + (i - 0.5) * step;
        last = next;
      }
      if (expected < 0.0) {
        if (!found) continue;
        // A pair of roots within a step, or a touch.
        EXPECT_LT(std::abs(printed(surface, origin + *found * ray.direction)), 1e-3) << toText(surface);
        continue;
      }
      ++hits;
      ASSERT_TRUE(found.has_value()) << toText(surface) << " " << trial;
      EXPECT_LE(*found, expected + step);
      EXPECT_LT(std::abs(printed(surface, origin + *found * ray.direction)), 1e-6);
      if (*found < expected - step) {  // a pair of roots before it, within a step
        const double before = *found - step, after = *found + step;
        EXPECT_EQ(printed(surface, origin + before * ray.direction) > 0,
                  printed(surface, origin + after * ray.direction) > 0);
      }
    }
    EXPECT_GT(hits, 30) << toText(surface);
  }
}

}  // namespace
}  // namespace limen::surfaces

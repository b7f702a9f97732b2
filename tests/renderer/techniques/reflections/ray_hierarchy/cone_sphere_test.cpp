// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/ray_hierarchy/cone_sphere.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace limen::techniques {
namespace {

using Exact = glm::vec<3, long double>;
constexpr double kPi = 3.14159265358979323846;  // below the true one: angles up to it are in range

class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  double between(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  glm::dvec3 inBox(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  glm::dvec3 direction() {
    while (true) {
      const glm::dvec3 v = inBox(1.0);
      const double length = glm::length(v);
      if (length > 0.01 && length <= 1.0) return v / length;
    }
  }
  /// At an angle from a unit vector.
  glm::dvec3 aside(glm::dvec3 axis, double angle) {
    const glm::dvec3 across = glm::normalize(glm::cross(axis, direction()));
    return std::cos(angle) * axis + std::sin(angle) * across;
  }

 private:
  std::mt19937 engine_;
};

template <class T>
long double angleOf(const ConeSphere<T>& node) {
  return node.spread >= ConeSphere<T>::kAllDirections
             ? kPi
             : 2.0L * std::atan(static_cast<long double>(node.spread));
}

template <class T>
ConeSphere<T> randomNode(Random& random, double angle) {
  ConeSphere<T> node;
  node.centre = random.inBox(5.0);
  node.radius = static_cast<T>(random.between(0.0, 1.0) < 0.3 ? 0.0 : random.between(0.0, 2.0));
  node.axis = random.direction();
  node.spread = static_cast<T>(std::min(std::tan(0.5 * angle), double(ConeSphere<T>::kAllDirections)));
  return node;
}

/// In more digits than the nodes have, so that its own rounding is none.
struct ExactRay {
  Exact origin, direction;
};

/// A ray of the bundle, one in four at its very rim.
template <class T>
ExactRay rayOf(Random& random, const ConeSphere<T>& node) {
  const long double rim =
      (random.between(0.0, 1.0) < 0.25 ? 1.0L : random.between(0.0, 1.0)) * (1.0L - 1e-18L);
  const Exact axis = glm::normalize(Exact(node.axis));
  const Exact across = glm::normalize(glm::cross(axis, Exact(random.direction())));
  const long double angle = rim * angleOf(node);
  return {Exact(node.centre) +
              rim * static_cast<long double>(node.radius) * glm::normalize(Exact(random.direction())),
          std::cos(angle) * axis + std::sin(angle) * across};
}

template <class T>
class ConeSphereTest : public testing::Test {};
using Numbers = testing::Types<float, double>;
TYPED_TEST_SUITE(ConeSphereTest, Numbers);

/// Spheres that a ray of the bundle meets by construction: around a point of the ray, no farther from it than
/// their radius. The printed form of equation 3.1 misses every bundle wider than pi / 2: its share of angles
/// that are uniform in 0..pi is one half, less the 0.002 / pi that count as all directions. Four standard
/// deviations of a share of 10^6 cases are 0.002.
TYPED_TEST(ConeSphereTest, NoSphereThatARayMeetsIsMissed) {
  using T = TypeParam;
  constexpr int kCases = 1000000;
  Random random(1);
  int robust = 0, tight = 0, printed = 0, printedNarrow = 0;
  for (int i = 0; i < kCases; ++i) {
    const double angle = i % 8 == 0 ? 0.0 : random.between(0.0, kPi);
    const auto node = randomNode<T>(random, i % 8 == 0 && i % 16 == 0 ? random.between(0.0, 0.01) : angle);
    const ExactRay ray = rayOf(random, node);
    const Exact point = ray.origin + static_cast<long double>(random.between(0.0, 20.0)) * ray.direction;
    const long double wanted = random.between(0.0, 1.0) < 0.2 ? 0.0 : random.between(0.0, 1.0);
    const glm::vec<3, T> centre(point + wanted * Exact(random.direction()));
    const auto radius = static_cast<T>(glm::length(Exact(centre) - point) * (1.0L + 1e-7L));
    robust += !cone_sphere::mayMeet(node, centre, radius, BundleTest::Robust);
    tight += !cone_sphere::mayMeet(node, centre, radius, BundleTest::Tight);
    const bool missed = !cone_sphere::mayMeet(node, centre, radius, BundleTest::Printed);
    printed += missed && i % 8 != 0;
    printedNarrow += missed && angleOf(node) < 0.5 * kPi - 1e-3;
  }
  EXPECT_EQ(robust, 0);
  EXPECT_EQ(tight, 0);
  EXPECT_EQ(printedNarrow, 0);
  EXPECT_NEAR(printed / (0.875 * kCases), 0.5 - 0.002 / kPi, 0.002);
}

/// The tight form is the distance to the solid cone, here the least over 400 of its rays in the plane of axis
/// and sphere: neighbouring rays are angle / 400 apart, so none is nearer by more than |v| angle / 800. The
/// robust form is as tight except behind the apex.
TYPED_TEST(ConeSphereTest, TightFormRejectsWhatIsOutOfReach) {
  using T = TypeParam;
  Random random(2);
  int rejected = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto node = randomNode<T>(random, random.between(0.0, 3.1));
    const glm::vec<3, T> centre(random.inBox(20.0));
    const auto radius = static_cast<T>(random.between(0.0, 3.0));
    const glm::dvec3 v = glm::dvec3(centre) - glm::dvec3(node.centre), axis(node.axis);
    const double along = glm::dot(v, axis), beside = glm::length(v - along * axis), size = glm::length(v);
    const double angle = static_cast<double>(angleOf(node));
    double nearest = size;
    for (int k = 0; k <= 400; ++k) {
      const double turn = angle * k / 400.0;
      const double ahead = along * std::cos(turn) + beside * std::sin(turn);
      if (ahead > 0.0)
        nearest = std::min(nearest, std::abs(beside * std::cos(turn) - along * std::sin(turn)));
    }
    const double least = nearest - size * angle / 800.0, reach = double(node.radius) + double(radius);
    if (!(least > reach + 1e-5 * size)) continue;
    ++rejected;
    EXPECT_FALSE(cone_sphere::mayMeet(node, centre, radius, BundleTest::Tight)) << i;
  }
  EXPECT_GT(rejected, 5000);
}

template <class T>
void expectWithin(const ConeSphere<T>& whole, const ExactRay& ray) {
  ASSERT_FALSE(whole.empty());
  EXPECT_LE(glm::length(Exact(ray.origin) - Exact(whole.centre)),
            static_cast<long double>(whole.radius) + 1e-18L);
  if (whole.spread >= ConeSphere<T>::kAllDirections) return;
  const Exact axis = glm::normalize(Exact(whole.axis)), direction = glm::normalize(Exact(ray.direction));
  // 1e-18: rounding of this check.
  EXPECT_LE(std::atan2(glm::length(glm::cross(axis, direction)), glm::dot(axis, direction)),
            angleOf(whole) + 1e-18L);
}

TYPED_TEST(ConeSphereTest, MergedBundlesContainTheirParts) {
  using T = TypeParam;
  for (const BundleMerge how : {BundleMerge::Mean, BundleMerge::Pairwise}) {
    Random random(3);
    for (int i = 0; i < 20000 && !testing::Test::HasFailure(); ++i) {
      // From rays alone to half-spaces; some nearly alike, as neighbouring pixels are, some opposed.
      const double widest = i % 3 == 0 ? 0.0 : i % 3 == 1 ? 0.2 : 3.1;
      std::vector<ConeSphere<T>> parts;
      for (int k = 0; k < 4; ++k) {
        auto part = randomNode<T>(random, random.between(0.0, widest));
        if (i % 3 == 0) part.radius = 0;
        if (i % 5 == 1 && k > 0) {
          part.axis = glm::dvec3(parts[0].axis) * (k % 2 ? -1.0 : 1.0);
        } else if (i % 5 == 2 && k > 0) {
          part.axis = random.aside(glm::normalize(glm::dvec3(parts[0].axis)), random.between(0.0, 1e-3));
          part.centre = glm::dvec3(parts[0].centre) + 1e-3 * random.direction();
        }
        if (random.between(0.0, 1.0) < 0.2) part = {};
        parts.push_back(part);
      }
      const auto whole = cone_sphere::merged<T>(parts, how);
      bool any = false;
      for (const auto& part : parts) {
        if (part.empty()) continue;
        any = true;
        for (int k = 0; k < 4; ++k) {
          ExactRay ray = rayOf(random, part);
          expectWithin(whole, ray);
        }
      }
      EXPECT_EQ(whole.empty(), !any);
    }
  }
}

/// Its direction may have any length.
TYPED_TEST(ConeSphereTest, ARaysNodeContainsTheRay) {
  using T = TypeParam;
  Random random(4);
  for (int i = 0; i < 20000; ++i) {
    const glm::vec<3, T> origin(random.inBox(5.0)), way(random.between(0.01, 100.0) * random.direction());
    expectWithin(cone_sphere::ofRay(origin, way), {Exact(origin), Exact(way)});
  }
}

/// Nothing can be said of the mean of directions that cancel, or of rays that go opposite ways.
TYPED_TEST(ConeSphereTest, DirectionsWithoutAMeanAreAllDirections) {
  using T = TypeParam;
  const auto ray = [](glm::dvec3 axis) {
    ConeSphere<T> node;
    node.radius = 0, node.axis = axis;
    return node;
  };
  for (const BundleMerge how : {BundleMerge::Mean, BundleMerge::Pairwise}) {
    const std::vector<ConeSphere<T>> opposed = {ray({0, 0, 1}), ray({0, 0, -1})};
    const std::vector<ConeSphere<T>> cancelling = {ray({1, 0, 0}), ray({-1, 0, 0}), ray({0, 1, 0}),
                                                   ray({0, -1, 0})};
    for (const auto& parts : {opposed, cancelling})
      for (const glm::dvec3& way : {glm::dvec3(1, 0, 0), glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 1)})
        for (const double sign : {-1.0, 1.0})
          EXPECT_TRUE(cone_sphere::mayMeet(cone_sphere::merged<T>(parts, how),
                                           glm::vec<3, T>(5.0 * sign * way), T(0), BundleTest::Tight));
  }
}

/// The smallest of two: 90 degrees between rays make a cone of 45 around their middle, and two balls of
/// radius 1 at a distance of 2 one of radius 2.
TYPED_TEST(ConeSphereTest, PairwiseMergeIsSmallest) {
  using T = TypeParam;
  ConeSphere<T> a, b;
  a.radius = b.radius = 1;
  b.centre = {2, 0, 0};
  a.axis = {1, 0, 0}, b.axis = {0, 1, 0};
  const auto whole = cone_sphere::merged<T>(std::vector<ConeSphere<T>>{a, b}, BundleMerge::Pairwise);
  EXPECT_NEAR(whole.radius, 2.0, 1e-4);
  EXPECT_NEAR(whole.centre.x, 1.0, 1e-4);
  EXPECT_NEAR(angleOf(whole), kPi / 4.0, 1e-4);
  EXPECT_NEAR(whole.axis.x, std::sqrt(0.5), 1e-4);
}

}  // namespace
}  // namespace limen::techniques

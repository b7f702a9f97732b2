// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/many_lods/node_predicate.h"

#include "tests/renderer/many_lods/many_lods_fixture.h"

namespace limen::many_lods {
namespace {

// What makes incremental cuts exact.
TEST(NodePredicate, ChildrenOfValidNodesAreValidForAllViews) {
  const SphereTree tree = treeOf(bumpyBalls(), 11);
  std::mt19937 random(5);
  uint64_t valid = 0, insideOf = 0;
  for (int i = 0; i < 10000; ++i) {
    const CutView view = anyView(random, tree, 0.25 * (1 << i % 6));
    // Along a way down, which finds the nodes of interest near the eye, and at random.
    for (int way = 0; way < 4; ++way) {
      uint32_t node = 1;
      while (node < tree.leafCount()) {
        const bool parentValid = isValid(tree.spheres[node], node, tree.leafCount(), view);
        const bool culled = isCulled(tree.spheres[node], node, tree.leafCount(), view);
        insideOf += std::isinf(relativeSize(tree.spheres[node], view)) ? 1 : 0;
        for (const uint32_t child : {2 * node, 2 * node + 1}) {
          if (parentValid) {
            ASSERT_TRUE(isValid(tree.spheres[child], child, tree.leafCount(), view))
                << "view " << i << ", node " << node;
          }
          if (culled) {
            ASSERT_TRUE(isCulled(tree.spheres[child], child, tree.leafCount(), view));
          }
        }
        valid += parentValid ? 1 : 0;
        const glm::vec3 eye(view.eye);
        const bool right = glm::distance(glm::vec3(tree.spheres[2 * node + 1]), eye) <
                           glm::distance(glm::vec3(tree.spheres[2 * node]), eye);
        node = 2 * node + (way == 0 ? (right ? 1U : 0U) : random() % 2);
      }
    }
  }
  EXPECT_GT(valid, 50000U);
  EXPECT_GT(insideOf, 10000U);
}

// In double precision, as defined: the diameter's size against epsilon, and whether any of the sphere lies in
// the view. Floats may decide otherwise within 1e-5 of equality, and what is culled lies outside by the slack
// at most.
TEST(NodePredicate, AgreesWithItsDefinitionInDoublePrecision) {
  const SphereTree tree = treeOf(bumpyBalls(), 11);
  std::mt19937 random(6);
  int culledCount = 0, near = 0;
  for (int i = 0; i < 200000; ++i) {
    const CutView view = anyView(random, tree);
    const uint32_t node = 1 + random() % (tree.leafCount() - 1);
    const glm::vec4 sphere = tree.spheres[node];
    const double size = relativeSize(sphere, view);
    const glm::dvec3 v = glm::dvec3(glm::vec3(sphere)) - glm::dvec3(glm::vec3(view.eye));
    const double depth = glm::dot(v, glm::dvec3(glm::vec3(view.axisZ)));
    double outside = -depth - sphere.w;
    if (view.axisZ.w == float(kViewPerspective)) {
      const auto plane = [&](glm::vec4 axis) {
        const double half = std::atan(double(axis.w));
        const double along = std::abs(glm::dot(v, glm::dvec3(glm::vec3(axis))));
        return along * std::cos(half) - depth * std::sin(half) - double(sphere.w);
      };
      outside = std::max({outside, plane(view.axisX), plane(view.axisY)});
    }
    // Slack: 32 u for each of 11 levels, of a sum of coordinates of at most sqrt(3) times the distance.
    const double slack =
        11.0 * kCullSlack * std::sqrt(3.0) * glm::length(v) + 1e-5 * (glm::length(v) + sphere.w);
    const bool culled = isCulled(sphere, node, tree.leafCount(), view);
    if (culled) {
      ASSERT_GT(outside, -1e-6 * (glm::length(v) + sphere.w));
      ++culledCount;
    } else {
      ASSERT_LT(outside, slack);
    }
    if (std::abs(size - 1.0) < 1e-5) {
      ++near;
      continue;
    }
    ASSERT_EQ(isValid(sphere, node, tree.leafCount(), view), size < 1.0 || culled) << "size " << size;
  }
  EXPECT_GT(culledCount, 20000);
  EXPECT_LT(near, 1000);
}

// A ball of diameter 0.02 at distance 1, straight ahead: of 512 pixels of a perspective view with a field of
// view of 90 degrees it covers 0.02 x 256 = 5.12. On a hemisphere's tile of 64 pixels, its solid angle, pi
// 0.01^2, is that share of 2 pi of the pi 32^2 pixels: 0.16, of diameter 0.4525.
TEST(NodePredicate, SizesAreDiametersInPixels) {
  const glm::vec4 ball(0.0F, 0.0F, -1.0F, 0.01F);
  for (const double factor : {0.999, 1.001}) {
    const CutView perspective =
        perspectiveView({0, 0, 0}, {0, 0, -1}, {0, -1, 0}, {1.0, 1.0}, 512, 5.12 * factor, 10.0);
    EXPECT_EQ(isValid(ball, 1, 2, perspective), factor > 1.0);
    const CutView hemisphere = hemisphereView({0, 0, 0}, {0, 0, -1}, 64, 0.4525 * factor, 10.0);
    EXPECT_EQ(isValid(ball, 1, 2, hemisphere), factor > 1.0);
  }
}

}  // namespace
}  // namespace limen::many_lods

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "renderer/many_lods/node_predicate.h"
#include "renderer/many_lods/sphere_tree.h"
#include "tests/renderer/gl/gl_fixture.h"

namespace limen::many_lods {

struct Triangles {
  std::vector<glm::dvec3> positions;
  std::vector<glm::uvec3> triangles;

  void add(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const auto first = static_cast<uint32_t>(positions.size());
    positions.insert(positions.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
  }
};

/// Bumpy balls of different sizes, slivers, and a large floor.
inline Triangles bumpyBalls(int balls = 3, int side = 12) {
  Triangles out;
  const auto at = [](int ball, double u, double v) {
    const double a = 2.0 * std::numbers::pi * u, b = std::numbers::pi * v;
    const double radius = (1.0 + 0.3 * ball) * (1.0 + 0.1 * std::sin(7.0 * a) * std::sin(5.0 * b));
    return glm::dvec3(4.0 * ball, 1.5, -2.0 * ball) +
           radius * glm::dvec3(std::sin(b) * std::cos(a), std::cos(b), std::sin(b) * std::sin(a));
  };
  for (int ball = 0; ball < balls; ++ball)
    for (int j = 0; j < side; ++j)
      for (int i = 0; i < 2 * side; ++i) {
        const double u = i / (2.0 * side), v = double(j) / side, du = 0.5 / side, dv = 1.0 / side;
        out.add(at(ball, u, v), at(ball, u + du, v), at(ball, u + du, v + dv));
        out.add(at(ball, u, v), at(ball, u + du, v + dv), at(ball, u, v + dv));
      }
  out.add({-20, -2, -20}, {-20, -2, 20}, {20, -2, 20});
  out.add({-20, -2, -20}, {20, -2, 20}, {20, -2, -20});
  out.add({-20, 3, 0}, {20, 3, 0}, {20, 3.0001, 0});
  return out;
}

inline SphereTree treeOf(const Triangles& of, int depth, double leafScale = 1.5) {
  return buildSphereTree(of.positions, of.triangles, glm::dvec3(0.0),
                         {.depth = depth, .leafScale = leafScale, .seed = 7});
}

inline glm::dvec3 anyDirection(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
}

/// Views of both kinds, from far away to within the surface, a share of them at points of the tree.
inline CutView anyView(std::mt19937& random, const SphereTree& tree, double epsilonPx = 1.0) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  glm::dvec3 eye = anyDirection(random) * 30.0 * std::pow(unit(random), 3.0);
  const double kind = unit(random);
  if (kind < 0.3) eye = glm::vec3(tree.spheres[tree.leafCount() + random() % tree.leafCount()]);
  if (kind > 0.95) eye *= 1e4;
  const glm::dvec3 axis = anyDirection(random);
  const int side = 1 << (2 + random() % 6);
  if (random() % 2 == 0) return hemisphereView(eye, axis, side, epsilonPx, 100.0);
  return perspectiveView(eye, axis, anyDirection(random), {0.1 + unit(random), 0.1 + unit(random)}, side,
                         epsilonPx, 100.0);
}

inline gl::Buffer bufferOf(const std::vector<CutView>& views) { return gl::Buffer(views); }

}  // namespace limen::many_lods

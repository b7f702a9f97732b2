// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

namespace limen::ray_tracing {

struct Soup {
  std::vector<glm::vec3> vertices;
  std::vector<glm::uvec3> triangles;
  void add(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
    const auto first = static_cast<uint32_t>(vertices.size());
    vertices.insert(vertices.end(), {a, b, c});
    triangles.emplace_back(first, first + 1, first + 2);
  }
};

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double in(double low, double high) { return low + (high - low) * double(random_()) * 0x1p-32; }
  glm::dvec3 inCube(double half) { return {in(-half, half), in(-half, half), in(-half, half)}; }
  glm::dvec3 direction() {
    const double z = in(-1.0, 1.0), angle = in(0.0, 2.0 * std::numbers::pi), r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
  }

 private:
  std::mt19937 random_;
};

inline Soup randomSoup(unsigned seed, int count, double size, glm::dvec3 middle = {}) {
  Dice dice(seed);
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 at = middle + dice.inCube(1.0);
    soup.add(at, at + dice.inCube(size), at + dice.inCube(size));
  }
  return soup;
}

/// Long and thin, some a millionth as wide as long.
inline Soup slivers(unsigned seed, int count) {
  Dice dice(seed);
  Soup soup;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 a = dice.inCube(1.0), b = dice.inCube(1.0);
    soup.add(a, b,
             glm::mix(a, b, dice.in(0.0, 1.0)) + dice.direction() * std::pow(10.0, dice.in(-6.0, -2.0)));
  }
  return soup;
}

/// What has no area or is not finite, among `soup`'s triangles; returns how many were added.
inline size_t addDegenerate(Soup& soup) {
  const float infinity = std::numeric_limits<float>::infinity(),
              nan = std::numeric_limits<float>::quiet_NaN();
  soup.add({0, 0, 0}, {0, 0, 0}, {0, 0, 0});
  soup.add({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  soup.add({0.5F, 0, 0}, {0.5F, 0, 0}, {0, 1, 0});
  soup.add({0, 0, 0}, {infinity, 0, 0}, {0, 1, 0});
  soup.add({0, 0, nan}, {1, 0, 0}, {0, 1, 0});
  return 5;
}

/// An octahedron whose triangles are divided in four `times` times, vertices on the sphere and shared.
inline Soup sphere(int times, float radius = 1.0F, glm::vec3 centre = {}) {
  Soup soup;
  soup.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (uint32_t x : {0U, 1U})
    for (uint32_t y : {2U, 3U})
      for (uint32_t z : {4U, 5U}) soup.triangles.emplace_back(x, y, z);
  for (int n = 0; n < times; ++n) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [at, isNew] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<uint32_t>(soup.vertices.size()));
      if (isNew) soup.vertices.push_back(glm::normalize(soup.vertices[a] + soup.vertices[b]));
      return at->second;
    };
    std::vector<glm::uvec3> finer;
    for (const glm::uvec3 t : soup.triangles) {
      const uint32_t a = middle(t.y, t.z), b = middle(t.z, t.x), c = middle(t.x, t.y);
      finer.insert(finer.end(), {{t.x, c, b}, {c, t.y, a}, {b, a, t.z}, {a, b, c}});
    }
    soup.triangles = std::move(finer);
  }
  for (glm::vec3& vertex : soup.vertices) vertex = centre + radius * vertex;
  return soup;
}

}  // namespace limen::ray_tracing

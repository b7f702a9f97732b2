// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/vertex_reflection/reflected_mesh.h"

#include <gtest/gtest.h>

#include <set>
#include <tuple>

#include "experiments/base/error.h"
#include "renderer/scene/shapes.h"

namespace limen::reflections {
namespace {

/// Euler's formula for a closed mesh: V = 2 + T / 2, if vertices are shared along all edges.
TEST(ReflectedMeshes, DivisionSharesAllVertices) {
  const scene::Mesh mesh = scene::sphere(glm::dvec3(0.0), 1.0, 4);
  for (const int segments : {1, 2, 5}) {
    const ReflectedMesh out = divided(mesh, segments, glm::dvec3(0.0));
    ASSERT_EQ(out.triangles.size(), mesh.triangles.size() * segments * segments);
    EXPECT_EQ(out.positions.size(), 2 + out.triangles.size() / 2);
    std::set<std::tuple<float, float, float>> places;
    for (const glm::vec3& p : out.positions) places.insert({p.x, p.y, p.z});
    EXPECT_EQ(places.size(), out.positions.size());
    // Triangles keep their source, its plane and its side.
    for (size_t i = 0; i < out.triangles.size(); ++i) {
      const glm::uvec3 s = mesh.triangles[out.sources[i]], t = out.triangles[i];
      const auto normal = [](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) { return glm::cross(b - a, c - a); };
      const glm::dvec3 whole = normal(mesh.positions[s.x], mesh.positions[s.y], mesh.positions[s.z]);
      const glm::dvec3 part = normal(out.positions[t.x], out.positions[t.y], out.positions[t.z]);
      EXPECT_LT(glm::length(part * double(segments * segments) - whole), 1e-4 * glm::length(whole));
    }
  }
}

TEST(ReflectedMeshes, AMirrorsOwnVerticesAreLeftOut) {
  scene::Mesh mesh = scene::sphere(glm::dvec3(0.0), 1.0, 2);
  const auto first = static_cast<uint32_t>(mesh.triangles.size());
  const size_t vertices = mesh.positions.size();
  scene::append(mesh, scene::box({2.0, 0.0, 0.0}, {3.0, 1.0, 1.0}));
  const auto own = divided(mesh, 1, glm::dvec3(0.0)).ownVertices(0, first);
  EXPECT_EQ(own.first, 0U);
  EXPECT_EQ(own.count, vertices);
  // A triangle elsewhere that shares a vertex needs it reflected.
  mesh.triangles.push_back({0, static_cast<uint32_t>(vertices), static_cast<uint32_t>(vertices) + 1});
  EXPECT_EQ(divided(mesh, 1, glm::dvec3(0.0)).ownVertices(0, first).count, 0U);
}

TEST(ReflectedMeshes, TooManyTrianglesAreRefused) {
  const scene::Mesh mesh = scene::sphere(glm::dvec3(0.0), 1.0, 64);
  EXPECT_THROW(divided(mesh, 64, glm::dvec3(0.0)), Error);
}

}  // namespace
}  // namespace limen::reflections

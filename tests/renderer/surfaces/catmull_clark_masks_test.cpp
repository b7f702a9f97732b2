// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/surfaces/catmull_clark_masks.h"

#include <gtest/gtest.h>

#include "renderer/scene/curved/double_torus.h"
#include "renderer/surfaces/catmull_clark.h"
#include "renderer/surfaces/catmull_clark_point.h"

namespace limen::surfaces {
namespace {

PolygonMesh cubeOf(double width) {
  PolygonMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.points.emplace_back(i & 1 ? width : -1, i & 2 ? 1 : -1, i & 4 ? 1.3 : -1);
  mesh.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  return mesh;
}

/// Kazakov: valence 3 of a cube, 4 and others of the rings, against subdivision itself.
TEST(CatmullClarkMasks, VerticesAfterStepsAreThoseOfSubdivision) {
  for (const PolygonMesh& mesh : {cubeOf(1.7), scene::doubleTorusCage()}) {
    const MeshTopology topology(mesh);
    for (const int steps : {0, 1, 2, 5}) {
      const PolygonMesh fine = catmullClark(mesh, steps);
      for (uint32_t v = 0; v < mesh.points.size(); ++v) {
        const VertexRing& ring = topology.rings()[v];
        const auto n = double(ring.faces.size());
        glm::dvec3 edges(0.0), faces(0.0);
        for (const uint32_t end : ring.edges) edges += mesh.points[end] / n;
        for (const uint32_t f : ring.faces) {
          const std::vector<uint32_t>& corners = mesh.faces[f];
          const auto own = size_t(std::find(corners.begin(), corners.end(), v) - corners.begin());
          faces += mesh.points[corners[(own + 2) % 4]] / n;
        }
        EXPECT_LT(glm::length(vertexAfterSteps(steps, int(n), mesh.points[v], edges, faces) - fine.points[v]),
                  1e-13)
            << steps;
      }
    }
  }
}

/// Against limit masks after one step: corners, middles of edges and of the face.
void expectLimits(const PolygonMesh& mesh, size_t mostTables) {
  const MeshTopology topology(mesh);
  const PolygonMesh fine = catmullClark(mesh);
  const LimitPoints limit = catmullClarkLimit(fine);
  CatmullClarkMasks masks(2);
  for (uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const std::vector<glm::dvec3> grid = masks.grid(mesh, topology, f);
    ASSERT_EQ(grid.size(), 9U);
    // Child i: (vertex, edge to the next, face, edge from the one before).
    const std::array<std::array<size_t, 2>, 4> places = {{{0, 1}, {2, 5}, {8, 7}, {6, 3}}};
    for (size_t i = 0; i < 4; ++i) {
      const std::vector<uint32_t>& child = fine.faces[4 * f + i];
      EXPECT_LT(glm::length(grid[places[i][0]] - limit.points[child[0]]), 1e-10);
      EXPECT_LT(glm::length(grid[places[i][1]] - limit.points[child[1]]), 1e-10);
      EXPECT_LT(glm::length(grid[4] - limit.points[child[2]]), 1e-10);
    }
  }
  EXPECT_LE(masks.tables(), mostTables);
  EXPECT_GT(masks.tables(), 0U);
}

TEST(CatmullClarkMasks, GridsAreTheLimitOfSubdivision) {
  expectLimits(cubeOf(1.2), 6);
  // 192 quads, of which those with regular corners share one table.
  expectLimits(catmullClark(scene::doubleTorusCage()), 60);
  // A closed crease: limit masks do not hold where one ends.
  PolygonMesh creased = cubeOf(1.0);
  for (size_t c = 0; c < 4; ++c)
    creased.sharpness[edgeKey(creased.faces[0][c], creased.faces[0][(c + 1) % 4])] = kInfinitelySharp;
  creased = catmullClark(creased);
  expectLimits(creased, 24);
}

/// Numbers of segments that subdivision never reaches.
TEST(CatmullClarkMasks, GridsOfAnyNumberOfSegments) {
  const PolygonMesh mesh = scene::doubleTorusCage();
  const MeshTopology topology(mesh);
  for (const int segments : {1, 3, 5}) {
    CatmullClarkMasks masks(segments);
    for (uint32_t f = 0; f < mesh.faces.size(); f += 5) {
      const std::vector<glm::dvec3> grid = masks.grid(mesh, topology, f);
      for (int j = 0; j <= segments; ++j)
        for (int i = 0; i <= segments; ++i)
          EXPECT_LT(
              glm::length(grid[size_t(i + (segments + 1) * j)] -
                          catmullClarkPoint(mesh, f, double(i) / segments, double(j) / segments).position),
              1e-10);
    }
  }
}

}  // namespace
}  // namespace limen::surfaces

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/shapes.h"
#include "renderer/scene/stage.h"
#include "renderer/voxels/exact_voxels.h"
#include "tests/renderer/voxels/clipped_triangle.h"

namespace limen::voxels {

/// Triangles of all sizes and shapes: smaller than a voxel, slivers, large slanted ones, segments, points.
inline scene::Scene soup(int64_t seed) {
  scene::Random random(seed);
  scene::Mesh mesh;
  for (int i = 0; i < 300; ++i) {
    const double reach = i < 200 ? 0.02 : 1.0;
    const glm::dvec3 middle{random.uniform(-1, 1), random.uniform(-0.6, 0.6), random.uniform(-0.8, 0.8)};
    glm::dvec3 corners[3];
    for (glm::dvec3& corner : corners) corner = middle + random.uniform(0.0, reach) * random.direction();
    if (i % 10 == 1) corners[2] = 0.5 * (corners[0] + corners[1]);
    if (i % 10 == 2) corners[2] = corners[1] + 1e-5 * random.direction();
    if (i % 50 == 3) corners[1] = corners[2] = corners[0];
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners, corners + 3);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  scene::Scene scene;
  scene::addPart(scene, "soup", mesh, glm::vec3(0.5F));
  return scene;
}

/// Voxels that only the mesh meets if it may lie off by `slack` voxels.
inline int64_t beyond(const std::vector<uint8_t>& found, const scene::Mesh& mesh, const VoxelGrid& grid,
                      double slack) {
  std::vector<uint8_t> explained(found.size());
  for (const glm::uvec3 triangle : mesh.triangles) {
    const glm::dvec3 at[3] = {grid.toVoxels(mesh.positions[triangle.x]),
                              grid.toVoxels(mesh.positions[triangle.y]),
                              grid.toVoxels(mesh.positions[triangle.z])};
    const glm::ivec3 low = glm::max(glm::ivec3(glm::floor(glm::min(at[0], glm::min(at[1], at[2])) - 0.1)), 0);
    const glm::ivec3 high =
        glm::min(glm::ivec3(glm::floor(glm::max(at[0], glm::max(at[1], at[2])) + 0.1)), grid.resolution - 1);
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
          const auto index = static_cast<size_t>(grid.indexOf({x, y, z}));
          if (found[index] && !explained[index] && clippedMeets(at, {x, y, z}, slack)) explained[index] = 1;
        }
  }
  return compare(found, explained).extra;
}

}  // namespace limen::voxels

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <unordered_map>

#include "renderer/scene/scene.h"
#include "renderer/voxels/volume.h"
#include "renderer/voxels/voxel_grid.h"

namespace limen::voxels {

/// What lies within a voxel, weighted by its area: triangles cut by the voxel's sides, in double precision.
struct ExactAttributes {
  double area = 0.0;       ///< in squares of a voxel's side
  glm::dvec3 normal{0.0};  ///< mean unit normal, by the order of vertices
  glm::dvec3 albedo{0.0};  ///< mean of the materials', without patterns
};

/// By VoxelGrid::indexOf(); voxels that hold no area have no entry. `mesh`: the scene's, where its parts are.
std::unordered_map<int64_t, ExactAttributes> exactAttributes(const scene::Scene& scene,
                                                             const scene::Mesh& mesh, const VoxelGrid& grid);

/// Root mean square differences of a volume's attributes over those of its voxels that hold area.
struct AttributeError {
  double albedo = 0.0;  ///< of channels
  double normalDeg =
      0.0;  ///< angle between mean normals, where both are longer than a tenth: opposite sides cancel
  int64_t voxels = 0, normals = 0;  ///< compared
};
/// Waits for the GPU. The volume has Albedo and Normal.
AttributeError compare(const Volume& volume, const std::unordered_map<int64_t, ExactAttributes>& exact);

}  // namespace limen::voxels

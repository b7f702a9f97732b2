// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/voxels/voxel_grid.h"

namespace limen::voxels {

/// Sets of voxels, computed on the CPU in double precision, to compare with. One byte a voxel in the order of
/// VoxelGrid::indexOf(): 1 if it is in the set. Triangles that are not finite are left out.

/// Whether a triangle meets a voxel, borders included: no plane separates them, along the 13 directions that
/// suffice for a triangle and a box (Akenine-Möller 2001). Triangles without area count as the segments or
/// points that they are. Positions in voxels.
/// `slack`: the voxel reaches this much farther on all sides.
bool meetsVoxel(const glm::dvec3 (&corners)[3], glm::ivec3 voxel, double slack = 0.0);

/// All voxels that the mesh meets (BL-08). A surface exactly between two voxels meets both.
std::vector<uint8_t> exactVoxels(const scene::Mesh& mesh, const VoxelGrid& grid, double slack = 0.0);

/// Voxels in which the mesh meets a middle line along an axis, the ends of the lines left out by `margin`
/// voxels: those that no voxelization without holes may lack (Laine 2013, 6-separating).
std::vector<uint8_t> separatingVoxels(const scene::Mesh& mesh, const VoxelGrid& grid, double margin);

/// Two sets side by side.
struct SetDifference {
  int64_t missing = 0, extra = 0;  ///< voxels of `expected` alone; of `found` alone
};
SetDifference compare(const std::vector<uint8_t>& found, const std::vector<uint8_t>& expected);
int64_t countOf(const std::vector<uint8_t>& voxels);

}  // namespace limen::voxels

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/voxels/voxel_grid.h"

namespace limen::voxels {

/// Distances from the points of one set to the other set, world units.
struct DirectedDistances {
  double largest = 0.0, mean = 0.0, rms = 0.0;
};

/// Between the middles of occupied voxels and a surface (Gaitatzes 2012, section 7.7): exact distances from
/// middles to the triangles, and from points spread over the area of what of the surface lies in the
/// grid to the nearest middle.
struct HausdorffDistances {
  DirectedDistances fromVoxels, fromSurface;
  /// Two-sided: the larger of both. Infinite if one set is empty and the other is not.
  double largest() const { return larger(&DirectedDistances::largest); }
  double mean() const { return larger(&DirectedDistances::mean); }
  double rms() const { return larger(&DirectedDistances::rms); }

 private:
  double larger(double DirectedDistances::*figure) const {
    return fromVoxels.*figure > fromSurface.*figure ? fromVoxels.*figure : fromSurface.*figure;
  }
};

/// `occupied`: a byte a voxel in the order of VoxelGrid::indexOf(). `samples`: points on the mesh, and
/// middles at most: of more, every so many. Triangles that are not finite are left out.
HausdorffDistances hausdorff(const scene::Mesh& mesh, const VoxelGrid& grid,
                             const std::vector<uint8_t>& occupied, int samples = 20000, int64_t seed = 1);

}  // namespace limen::voxels

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/voxel_grid.h"

#include <algorithm>
#include <cmath>

namespace limen::voxels {

VoxelGrid tightGrid(const scene::Bounds& bounds, int longest, Sides sides) {
  VoxelGrid grid;
  const glm::dvec3 extent = bounds.empty() ? glm::dvec3(0.0) : bounds.high - bounds.low;
  const double side = std::max({extent.x, extent.y, extent.z});
  if (!(side > 0.0)) {
    grid.origin = (bounds.empty() ? glm::dvec3(0.0) : bounds.low) - 0.5;
    return grid;
  }
  constexpr double kRounding = 1e-9;  // of a side's length in voxels
  grid.origin = bounds.low;
  grid.voxelSize = side / longest;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = extent[axis] / grid.voxelSize;
    const double whole =
        sides == Sides::Nearest ? std::round(length) : std::ceil(length - kRounding * longest);
    grid.resolution[axis] = std::clamp(static_cast<int>(whole), 1, longest);
  }
  return grid;
}

}  // namespace limen::voxels

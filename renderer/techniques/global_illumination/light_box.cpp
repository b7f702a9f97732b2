// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/light_box.h"

#include <algorithm>
#include <cmath>

namespace limen::techniques {
namespace {

constexpr double kBeyondScene = 0.95;  // voxels

}  // namespace

voxels::VoxelGrid lightBox(const scene::Scene& scene, int resolution, int multiple) {
  scene::Bounds bounds = scene.bounds();
  const glm::dvec3 extent = bounds.high - bounds.low;
  const double longest = std::max({extent.x, extent.y, extent.z});
  voxels::VoxelGrid grid;
  if (longest > 0.0 && std::isfinite(longest)) {
    const double size = longest / (resolution - 2.0 * kBeyondScene);
    bounds.low -= kBeyondScene * size;
    bounds.high += kBeyondScene * size;
  }
  grid = voxels::tightGrid(bounds, resolution);
  grid.resolution = (grid.resolution + (multiple - 1)) / multiple * multiple;
  return grid;
}

}  // namespace limen::techniques

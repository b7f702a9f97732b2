// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/incremental_voxels/moving_bricks.h"

#include <algorithm>
#include <cmath>

namespace limen::incremental_voxels {
namespace {

int64_t bricksOf(const voxels::VoxelGrid& grid) {
  const glm::ivec3 counts = brickCounts(grid);
  return int64_t{counts.x} * counts.y * counts.z;
}

}  // namespace

MovingBricks::MovingBricks(const scene::Scene& scene, const voxels::VoxelGrid& grid)
    : grid_(grid), isListed_(static_cast<size_t>(bricksOf(grid))), buffer_(4 * bricksOf(grid), nullptr) {
  for (const scene::PartMotion& motion : scene.motions) {
    Moving moving{motion, {}};
    const scene::Part& part = scene.parts[motion.part];
    for (uint32_t i = part.firstTriangle; i < part.firstTriangle + part.triangleCount; ++i)
      for (int corner = 0; corner < 3; ++corner) {
        const glm::dvec3 position = scene.mesh.positions[scene.mesh.triangles[i][corner]];
        if (std::isfinite(position.x + position.y + position.z)) moving.rest.extend(position);
      }
    if (!moving.rest.empty()) parts_.push_back(moving);
  }
  listed_.reserve(isListed_.size());
}

void MovingBricks::add(double timeS) {
  const size_t before = listed_.size();
  const glm::ivec3 counts = brickCounts(grid_);
  for (const Moving& part : parts_) {
    // The box at rest, turned: it holds the part.
    scene::Bounds now;
    const glm::dmat4 at = part.motion.at(timeS);
    for (int i = 0; i < 8; ++i) {
      const glm::dvec3 corner(i & 1 ? part.rest.high.x : part.rest.low.x,
                              i & 2 ? part.rest.high.y : part.rest.low.y,
                              i & 4 ? part.rest.high.z : part.rest.low.z);
      now.extend(glm::dvec3(at * glm::dvec4(corner, 1.0)));
    }
    const glm::dvec3 brick(32.0, kBrickSide, kBrickSide);
    constexpr double kRounding = 0.01;  // voxels
    const glm::ivec3 low = glm::max(glm::ivec3(glm::floor((grid_.toVoxels(now.low) - kRounding) / brick)), 0);
    const glm::ivec3 high =
        glm::min(glm::ivec3(glm::floor((grid_.toVoxels(now.high) + kRounding) / brick)), counts - 1);
    for (int z = low.z; z <= high.z; ++z)
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x) {
          const int number = x + counts.x * (y + counts.y * z);
          uint8_t& is = isListed_[static_cast<size_t>(number)];
          if (is) continue;
          is = 1;
          listed_.push_back(static_cast<uint32_t>(number));
        }
  }
  if (listed_.size() > before)
    buffer_.write(4 * static_cast<int64_t>(before), 4 * static_cast<int64_t>(listed_.size() - before),
                  &listed_[before]);
}

void MovingBricks::restart(const voxels::VoxelGrid& grid) {
  grid_ = grid;
  std::fill(isListed_.begin(), isListed_.end(), uint8_t{0});
  listed_.clear();
}

}  // namespace limen::incremental_voxels

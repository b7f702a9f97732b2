// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/incremental_voxels/moving_bricks.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace limen::incremental_voxels {
namespace {

int64_t bricksOf(const voxels::VoxelGrid& grid) {
  const glm::ivec3 counts = brickCounts(grid);
  return int64_t{counts.x} * counts.y * counts.z;
}

struct Run {
  int first = 0, last = -1;
};
using Runs = std::array<Run, 2>;

/// Bricks along an axis in which a box's voxels are stored: around the end of the axis and on at its
/// beginning.
Runs bricksOfAxis(const voxels::VoxelGrid& grid, const scene::Bounds& box, int axis, glm::ivec3 wrap) {
  constexpr double kRounding = 0.01;  // voxels
  const int size = grid.resolution[axis], side = axis == 0 ? 32 : kBrickSide;
  const double low = std::floor(grid.toVoxels(box.low)[axis] - kRounding),
               high = std::floor(grid.toVoxels(box.high)[axis] + kRounding);
  if (!(high >= 0.0 && low < size)) return {};
  const int first = static_cast<int>(std::max(low, 0.0)) + wrap[axis],
            last = static_cast<int>(std::min(high, size - 1.0)) + wrap[axis];
  if (first >= size) return {Run{(first - size) / side, (last - size) / side}};
  if (last < size) return {Run{first / side, last / side}};
  return {Run{first / side, (size - 1) / side}, Run{0, (last - size) / side}};
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

void MovingBricks::list(int brick) {
  uint8_t& is = isListed_[static_cast<size_t>(brick)];
  if (is) return;
  is = 1;
  listed_.push_back(static_cast<uint32_t>(brick));
}

void MovingBricks::add(double timeS, glm::ivec3 wrap) {
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
    const Runs xs = bricksOfAxis(grid_, now, 0, wrap), ys = bricksOfAxis(grid_, now, 1, wrap),
               zs = bricksOfAxis(grid_, now, 2, wrap);
    for (const Run& z : zs)
      for (const Run& y : ys)
        for (const Run& x : xs)
          for (glm::ivec3 brick(x.first, y.first, z.first); brick.z <= z.last; ++brick.z)
            for (brick.y = y.first; brick.y <= y.last; ++brick.y)
              for (brick.x = x.first; brick.x <= x.last; ++brick.x)
                list(brick.x + counts.x * (brick.y + counts.y * brick.z));
  }
  if (listed_.size() > before)
    buffer_.write(4 * static_cast<int64_t>(before), 4 * static_cast<int64_t>(listed_.size() - before),
                  &listed_[before]);
}

void MovingBricks::moveTo(const voxels::VoxelGrid& grid, glm::ivec3 by) {
  grid_ = grid;
  if (glm::all(glm::lessThan(glm::abs(by), grid.resolution))) return;
  std::fill(isListed_.begin(), isListed_.end(), uint8_t{0});
  listed_.clear();
}

}  // namespace limen::incremental_voxels

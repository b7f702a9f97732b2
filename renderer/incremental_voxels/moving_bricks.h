// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/incremental_voxels/clean_up.h"
#include "renderer/scene/scene.h"

namespace limen::incremental_voxels {

/// Bricks of a grid in which parts that move have been: only there can a voxel become stale. A brick stays in
/// the list, as nobody knows whether all of it has been seen since.
class MovingBricks {
 public:
  MovingBricks(const scene::Scene& scene, const voxels::VoxelGrid& grid);
  /// Where the parts are at a time of the frame. `wrap`: where voxel (0, 0, 0) is stored.
  void add(double timeS, glm::ivec3 wrap = glm::ivec3(0));
  /// The grid has moved by so many voxels. What scrolls keeps its bricks.
  void moveTo(const voxels::VoxelGrid& grid, glm::ivec3 by);
  /// Numbers, as CleanUp takes them.
  const gl::Buffer& list() const { return buffer_; }
  int count() const { return static_cast<int>(listed_.size()); }

 private:
  struct Moving {
    scene::PartMotion motion;
    scene::Bounds rest;
  };
  void list(int brick);
  voxels::VoxelGrid grid_;
  std::vector<Moving> parts_;
  std::vector<uint8_t> isListed_;
  std::vector<uint32_t> listed_;
  gl::Buffer buffer_;
};

}  // namespace limen::incremental_voxels

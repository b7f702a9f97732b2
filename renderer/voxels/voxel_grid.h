// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "renderer/scene/scene.h"

namespace limen::voxels {

/// A box of cubic voxels along the world's axes. Voxel (0, 0, 0) has its low corner at `origin`.
struct VoxelGrid {
  glm::dvec3 origin{0.0};  ///< world space
  double voxelSize = 1.0;  ///< world units, > 0
  glm::ivec3 resolution{1};

  glm::dvec3 centre(glm::ivec3 voxel) const { return origin + (glm::dvec3(voxel) + 0.5) * voxelSize; }
  /// Position in voxels: the integer parts are the voxel.
  glm::dvec3 toVoxels(glm::dvec3 world) const { return (world - origin) / voxelSize; }
  glm::dvec3 high() const { return origin + glm::dvec3(resolution) * voxelSize; }
  bool contains(glm::ivec3 voxel) const {
    return glm::all(glm::greaterThanEqual(voxel, glm::ivec3(0))) &&
           glm::all(glm::lessThan(voxel, resolution));
  }
  int64_t count() const { return int64_t{resolution.x} * resolution.y * resolution.z; }
  /// x fastest, then y.
  int64_t indexOf(glm::ivec3 voxel) const {
    return voxel.x + int64_t{resolution.x} * (voxel.y + int64_t{resolution.y} * voxel.z);
  }
};

/// How the shorter sides of a grid become whole numbers of voxels.
enum class Sides {
  Covering,  ///< rounded up: the grid holds all of the box
  Nearest    ///< as Gaitatzes 2012, Table 3: up to half a voxel may be left out
};

/// The tight grid around `bounds` (Gaitatzes 2012, section 6.2.3): its longest side has `longest` voxels, the
/// other two as many as they need; the box's low corner is the grid's. A side of a whole number of voxels,
/// but for rounding of doubles, does not get another. A box without extent, or none, gets one voxel of side 1
/// around its centre.
VoxelGrid tightGrid(const scene::Bounds& bounds, int longest, Sides sides = Sides::Covering);

}  // namespace limen::voxels

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/gl/context.h"
#include "renderer/incremental_voxels/incremental_bindings.h"
#include "renderer/voxels/volume.h"

namespace limen::incremental_voxels {

/// Voxels that are filled from samples of depth images and kept from step to step: a bit each and, if asked
/// for, attributes. A voxel's attributes stay until samples fall into it again, or it is emptied.
class SampledVolume {
 public:
  /// Samples of one step at most. `views`: that give samples. Starts empty. Throws Error if the device
  /// cannot hold it. `scrolls`: voxels stay as the grid moves, as far as they are still in it.
  SampledVolume(gl::Context& context, const voxels::VoxelGrid& grid, glm::dvec3 anchor, bool attributes,
                int views, int64_t samples, bool scrolls = false);

  /// Whether a surface was found. The volume itself configures programs, as its grid may have moved.
  const voxels::Volume& occupancy() const { return occupancy_; }
  const voxels::VoxelGrid& grid() const { return grid_; }
  /// Another place for the grid, a whole number of voxels off if it scrolls. Empties the volume, or, if it
  /// scrolls, those voxels that were not in the grid: nothing is copied, as the grid's places wrap around.
  /// Returns by how many voxels it moved; where nothing stays, by all that an axis has.
  glm::ivec3 moveTo(glm::dvec3 origin);
  bool scrolls() const { return scrolls_; }
  /// Where voxel (0, 0, 0) is stored.
  glm::ivec3 wrap() const { return wrap_; }
  /// Texel of textures, and bit of occupancy(), of a voxel.
  glm::ivec3 storedVoxel(glm::ivec3 voxel) const { return (voxel + wrap_) % grid_.resolution; }
  /// As Volume::readOccupied(), in the grid's order.
  std::vector<uint8_t> readOccupied() const;
  bool hasAttributes() const { return attributes_.has_value(); }
  /// RGBA16F arrays, alpha 1 where there is a surface, all 0 elsewhere. Only if asked for: mean normal,
  /// turned to the viewers and not of unit length;
  const gl::Texture& normal() const { return attributes_->normal; }
  const gl::Texture& albedo() const { return attributes_->albedo; }  ///< mean reflectance;
  /// radiance that leaves the surface at once: emission and the reflected light of the lights.
  const gl::Texture& light() const { return attributes_->light; }
  int64_t bytes() const;

  /// Visits the occupied voxels alone: clearing textures of many layers takes a GPU far longer.
  void clear() const;
  /// The next step begins: its counts are apart from the last one's.
  void turn() { turn_ = 1 - turn_; }
  /// Of the last step. Waits for the GPU.
  SampleCounts counts() const {
    return state_.read<SampleCounts>(turn_ * int64_t{sizeof(SampleCounts)}, 1)[0];
  }

  /// Uniforms and textures of volume.glsl.
  void configure(const gl::Program& program) const;
  /// Bits, attributes, state and their uniforms for shaders that fill.
  void bind(const gl::Program& program) const;
  /// What they are compiled with.
  gl::ShaderDefines defines() const;
  /// Only with attributes: sums of touched voxels, and how many places there are for them, a power of 2.
  const gl::Buffer& sums() const { return attributes_->sums; }
  uint32_t places() const { return places_; }

 private:
  /// Empties voxels that the grid did not hold before it moved by `shift`.
  void forgetEntered(glm::ivec3 shift) const;
  struct Attributes {
    gl::Texture normal, albedo, light;
    gl::Buffer sums;
  };
  voxels::VoxelGrid grid_;
  glm::dvec3 anchor_;
  voxels::Volume occupancy_;
  std::optional<Attributes> attributes_;
  bool scrolls_;
  uint32_t places_;
  gl::Buffer state_;
  glm::ivec3 wrap_{0};
  const gl::Program* forget_ = nullptr;
  int turn_ = 0;
};

}  // namespace limen::incremental_voxels

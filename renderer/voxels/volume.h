// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"
#include "renderer/voxels/voxel_grid.h"

namespace limen::voxels {

/// What voxels hold besides whether a surface meets them.
struct VolumeAttributes {
  bool albedo = false;  ///< mean linear reflectance of the surfaces
  bool normal = false;  ///< mean unit normal of the triangles, by the order of their vertices; and opacity
  gl::Format format = gl::Format::RGBA16F;  ///< RGBA16F or RGBA32F
  bool any() const { return albedo || normal; }
};

/// Voxels in GPU memory: array textures, x and y in texels and z in layers. What fills it says which
/// surfaces count in a voxel, and how often.
class Volume {
 public:
  /// `anchor`: of the scene (frame::GpuScene::anchor()), which positions on the GPU are relative to. Throws
  /// Error if the device cannot hold it.
  Volume(gl::Context& context, const VoxelGrid& grid, glm::dvec3 anchor,
         const VolumeAttributes& attributes = {});

  const VoxelGrid& grid() const { return grid_; }
  /// The same voxels elsewhere; what they hold is stale.
  void moveTo(glm::dvec3 origin) { grid_.origin = origin; }
  const VolumeAttributes& attributes() const { return attributes_; }
  /// R32UI, a bit a voxel: bit x % 32 of texel (x / 32, y) of layer z. Bits beyond the grid are 0.
  const gl::Texture& bits() const { return bits_; }
  /// rgb: mean albedo; a: 1. Empty voxels: 0. Only if asked for.
  const gl::Texture& albedo() const { return *albedo_; }
  /// xyz: mean normal, not of unit length; a: mean opacity, 1 minus the mean of the channels of
  /// Material::transmittance. Empty voxels: 0. Only if asked for.
  const gl::Texture& normal() const { return *normal_; }
  int64_t bytes() const;

  /// Empties it, to be filled by shaders that write to bits() and sums().
  void clear() const;
  /// For sums of attributes (voxel_bindings.h); null without attributes.
  const gl::Buffer* sums() const { return sums_ ? &*sums_ : nullptr; }
  /// Divides the sums of attributes.
  void finish() const;

  /// Uniforms and textures of volume.glsl, in a program that is compiled with defines().
  void configure(const gl::Program& program) const;
  gl::ShaderDefines defines() const;

  /// One byte a voxel, in the order of VoxelGrid::indexOf(): 1 if occupied. Waits for the GPU.
  std::vector<uint8_t> readOccupied() const;
  /// Sets bits() from what readOccupied() returns.
  void writeOccupied(const std::vector<uint8_t>& occupied) const;

 private:
  VoxelGrid grid_;
  glm::dvec3 anchor_;
  VolumeAttributes attributes_;
  gl::Texture bits_;
  std::optional<gl::Texture> albedo_, normal_;
  std::optional<gl::Buffer> sums_;
  const gl::Program* finish_ = nullptr;
};

}  // namespace limen::voxels

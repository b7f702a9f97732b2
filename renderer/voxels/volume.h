// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "renderer/gl/buffer.h"
#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"
#include "renderer/voxels/volume_attributes.h"
#include "renderer/voxels/voxel_grid.h"

namespace limen::voxels {

/// Voxels in GPU memory: array textures, x and y in texels and z in layers. What fills it says which
/// surfaces count in a voxel, and how often.
class Volume {
 public:
  /// `anchor`: of the scene (frame::GpuScene::anchor()), which positions on the GPU are relative to. Throws
  /// Error if it exceeds its budget or the device cannot hold it.
  Volume(gl::Context& context, const VoxelGrid& grid, glm::dvec3 anchor,
         const VolumeAttributes& attributes = {});

  const VoxelGrid& grid() const { return grid_; }
  /// The same voxels elsewhere; what they hold is stale.
  void moveTo(glm::dvec3 origin) { grid_.origin = origin; }
  /// With the format that the volume has got.
  const VolumeAttributes& attributes() const { return attributes_; }
  /// R32UI, a bit a voxel: bit x % 32 of texel (x / 32, y) of layer z. Bits beyond the grid are 0.
  const gl::Texture& bits() const { return bits_; }
  /// One of attributes(), as VoxelAttribute states.
  const gl::Texture& attachment(VoxelAttribute attribute) const {
    return *attachments_[static_cast<size_t>(attribute)];
  }
  const gl::Texture& albedo() const { return attachment(VoxelAttribute::Albedo); }
  const gl::Texture& normal() const { return attachment(VoxelAttribute::Normal); }
  int64_t bytes() const;

  /// Empties it, to be filled by shaders that write to bits() and sums(). Attachments are emptied where
  /// bits() says that voxels are occupied.
  void clear() const;
  /// For sums of attributes (SumLayout); null without these, or if not asked for. All 0 after finish().
  const gl::Buffer* sums() const { return sums_ ? &*sums_ : nullptr; }
  /// Occupied voxels that sums have no room for: they have no attributes (VolumeAttributes::mostOccupied).
  /// Waits for the GPU.
  int64_t withoutSums() const;
  /// Adds another's bits, of the same grid.
  void unite(const Volume& other) const;
  /// After the last bit and before the first sum: places for sums, with VoxelSums::Occupied.
  void numberOccupied() const;
  /// Attachments from the sums, in occupied voxels alone; with `base`, which has the same grid and
  /// attributes, was united with this one and keeps its sums, as if all had entered one volume.
  void finish(const Volume* base = nullptr) const;

  /// Uniforms and textures of volume.glsl, in a program that is compiled with defines().
  void configure(const gl::Program& program) const;
  gl::ShaderDefines defines() const;
  /// For programs that write to sums(): defines besides those above, and the fixed-point steps.
  gl::ShaderDefines sumDefines() const;
  void configureSums(const gl::Program& program) const;
  /// Steps of a sum to 1, and to a radiance of 1.
  double sumSteps() const;
  double lightSteps() const;

  /// Runs a program that includes volume_words.glsl and is compiled with defines().
  void dispatchWords(const gl::Program& program) const;

  /// One byte a voxel, in the order of VoxelGrid::indexOf(): 1 if occupied. Waits for the GPU.
  std::vector<uint8_t> readOccupied() const;
  /// Sets bits() from what readOccupied() returns.
  void writeOccupied(const std::vector<uint8_t>& occupied) const;

 private:
  void bindAttachments() const;

  VoxelGrid grid_;
  glm::dvec3 anchor_;
  VolumeAttributes attributes_;
  gl::Texture bits_;
  std::array<std::optional<gl::Texture>, kVoxelAttributes> attachments_;
  std::optional<gl::Buffer> sums_, occupied_;
  std::optional<gl::Texture> slots_;
  const gl::Program *empty_, *unite_, *erase_ = nullptr, *number_ = nullptr, *finish_ = nullptr,
                                      *finishWith_ = nullptr;
};

/// Whether sums of all voxels fit into the device's buffers, and into the budget.
bool fitSumsOfAll(const VoxelGrid& grid, VolumeAttributes attributes);

}  // namespace limen::voxels

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/voxels/volume.h"

#include <epoxy/gl.h>

#include "renderer/voxels/voxel_bindings.h"

namespace limen::voxels {

Volume::Volume(gl::Context& context, const VoxelGrid& grid, glm::dvec3 anchor,
               const VolumeAttributes& attributes)
    : grid_(grid),
      anchor_(anchor),
      attributes_(attributes),
      bits_(gl::Format::R32UI, {(grid.resolution.x + 31) / 32, grid.resolution.y}, 1, grid.resolution.z) {
  const glm::ivec3 size = grid.resolution;
  if (attributes.albedo) albedo_.emplace(attributes.format, glm::ivec2(size), 1, size.z);
  if (attributes.normal) normal_.emplace(attributes.format, glm::ivec2(size), 1, size.z);
  if (attributes.any()) {
    sums_.emplace(grid.count() * int64_t{kVoxelSums} * 4, nullptr);
    gl::ShaderDefines defines = this->defines();
    defines["VOLUME_FORMAT"] = attributes.format == gl::Format::RGBA32F ? "rgba32f" : "rgba16f";
    finish_ = &context.programs().compute("renderer/voxels/finish_volume.comp.glsl", defines);
  }
  clear();
  finish();
}

int64_t Volume::bytes() const {
  return bits_.bytes() + (albedo_ ? albedo_->bytes() : 0) + (normal_ ? normal_->bytes() : 0) +
         (sums_ ? sums_->bytes() : 0);
}

void Volume::clear() const {
  bits_.clearUint(glm::uvec4(0));
  if (sums_) sums_->clearUint(0);
}

void Volume::finish() const {
  if (!finish_) return;
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  sums_->bindStorage(kVoxelSumsBuffer);
  if (albedo_) albedo_->bindImage(kVolumeAlbedoImage, gl::Access::Write);
  if (normal_) normal_->bindImage(kVolumeNormalImage, gl::Access::Write);
  configure(*finish_);
  finish_->use();
  const glm::ivec3 groups = (grid_.resolution + glm::ivec3(7, 7, 0)) / glm::ivec3(8, 8, 1);
  glDispatchCompute(static_cast<GLuint>(groups.x), static_cast<GLuint>(groups.y),
                    static_cast<GLuint>(groups.z));
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

gl::ShaderDefines Volume::defines() const {
  gl::ShaderDefines defines;
  if (albedo_) defines["VOLUME_ALBEDO"] = "1";
  if (normal_) defines["VOLUME_NORMAL"] = "1";
  return defines;
}

void Volume::configure(const gl::Program& program) const {
  bits_.bindTexture(kVolumeBitsUnit);
  if (albedo_) albedo_->bindTexture(kVolumeAlbedoUnit);
  if (normal_) normal_->bindTexture(kVolumeNormalUnit);
  program.set("gridOrigin", glm::vec3(grid_.origin - anchor_));
  program.set("voxelSize", static_cast<float>(grid_.voxelSize));
  program.set("gridSizeX", grid_.resolution.x);
  program.set("gridSizeY", grid_.resolution.y);
  program.set("gridSizeZ", grid_.resolution.z);
}

std::vector<uint8_t> Volume::readOccupied() const {
  std::vector<uint8_t> out(static_cast<size_t>(grid_.count()));
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  const glm::ivec3 size = grid_.resolution;
  const int wide = bits_.sizePx().x;
  for (int z = 0; z < size.z; ++z) {
    const std::vector<uint32_t> words = bits_.readUintLayer(z);
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x)
        out[static_cast<size_t>(grid_.indexOf({x, y, z}))] =
            words[static_cast<size_t>(y) * wide + x / 32] >> (x % 32) & 1U;
  }
  return out;
}

void Volume::writeOccupied(const std::vector<uint8_t>& occupied) const {
  const glm::ivec3 size = grid_.resolution;
  const int wide = bits_.sizePx().x;
  for (int z = 0; z < size.z; ++z) {
    std::vector<uint32_t> words(static_cast<size_t>(wide) * size.y);
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x)
        if (occupied[static_cast<size_t>(grid_.indexOf({x, y, z}))])
          words[static_cast<size_t>(y) * wide + x / 32] |= 1U << (x % 32);
    bits_.writeUint(words, z);
  }
}

}  // namespace limen::voxels

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/incremental_voxelization/voxel_textures.h"

#include <algorithm>
#include <cmath>

#include "renderer/techniques/incremental_voxelization/point_raster_bindings.h"

namespace limen::techniques {
namespace {

/// Tiles beside each other, so that the atlas is about square.
int columnsOf(glm::ivec3 size) {
  const double columns = std::ceil(std::sqrt(double(size.z) * size.y / size.x));
  return std::clamp(static_cast<int>(columns), 1, size.z);
}

std::vector<gl::Texture> makeTargets(glm::ivec2 sizePx, int layers, int targets, gl::Format format) {
  std::vector<gl::Texture> out;
  for (int i = 0; i < targets; ++i) out.emplace_back(format, sizePx, 1, layers);
  return out;
}

gl::Framebuffer framebufferOf(const std::vector<gl::Texture>& targets) {
  std::vector<const gl::Texture*> colours;
  for (const gl::Texture& target : targets) colours.push_back(&target);
  return {colours, nullptr};
}

}  // namespace

VoxelTextures::VoxelTextures(glm::ivec3 size, VoxelLayout layout, int targets, gl::Format format)
    : VoxelTextures(layout == VoxelLayout::Layers
                        ? glm::ivec2(size)
                        : glm::ivec2(size) *
                              glm::ivec2(columnsOf(size), (size.z + columnsOf(size) - 1) / columnsOf(size)),
                    layout == VoxelLayout::Layers ? size.z : 0, columnsOf(size), targets, format) {}

VoxelTextures::VoxelTextures(glm::ivec2 sizePx, int layers, int columns, int targets, gl::Format format)
    : columns_(columns),
      targets_(makeTargets(sizePx, layers, targets, format)),
      framebuffer_(framebufferOf(targets_)) {
  clear();
}

void VoxelTextures::clear() const {
  for (const gl::Texture& target : targets_) target.clear(glm::vec4(0.0F));
}

int64_t VoxelTextures::bytes() const {
  int64_t sum = 0;
  for (const gl::Texture& target : targets_) sum += target.bytes();
  return sum;
}

void VoxelTextures::bindSources() const {
  for (size_t i = 0; i < targets_.size(); ++i)
    targets_[i].bindTexture(kVoxelSourceUnit + static_cast<uint32_t>(i));
}

void VoxelTextures::bindTargets() const {
  for (size_t i = 0; i < targets_.size(); ++i)
    targets_[i].bindImage(kVoxelTargetImage + static_cast<uint32_t>(i), gl::Access::Write);
}

void VoxelTextures::configure(const gl::Program& program) const {
  program.set("atlasColumns", columns_);
  program.set("targetSizePx", sizePx());
}

}  // namespace limen::techniques

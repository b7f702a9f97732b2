// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "experiments/base/enum_names.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::techniques {

/// Where voxels are in textures.
enum class VoxelLayout {
  Layers,  ///< of array textures; points reach them by a geometry shader
  Atlas    ///< layers side by side in plain textures; no geometry shader
};
constexpr EnumNames<VoxelLayout, 2> enumNames(VoxelLayout) {
  return {{{{VoxelLayout::Layers, "layers"}, {VoxelLayout::Atlas, "atlas"}}}};
}

/// A volume in one or four textures, into which points are drawn.
class VoxelTextures {
 public:
  VoxelTextures(glm::ivec3 size, VoxelLayout layout, int targets, gl::Format format);
  void clear() const;
  int64_t bytes() const;
  void bindSources() const;
  void bindTargets() const;
  void bindFramebuffer() const { framebuffer_.bind(); }
  const gl::Texture& target(int i) const { return targets_.at(static_cast<size_t>(i)); }
  glm::ivec2 sizePx() const { return targets_[0].sizePx(); }
  void configure(const gl::Program& program) const;

 private:
  VoxelTextures(glm::ivec2 sizePx, int layers, int columns, int targets, gl::Format format);
  int columns_;
  std::vector<gl::Texture> targets_;
  gl::Framebuffer framebuffer_;
};

}  // namespace limen::techniques

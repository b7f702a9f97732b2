// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "renderer/gl/context.h"
#include "renderer/gl/texture.h"
#include "renderer/incremental_voxels/depth_view.h"

namespace limen::incremental_voxels {

/// The least and the largest depth of each tile of depth images, by which whole bricks of voxels are decided.
class DepthTiles {
 public:
  DepthTiles(gl::Context& context, const std::vector<glm::ivec2>& viewSizesPx);
  /// Of views in the order and of the sizes given above. Opens no pass.
  void run(const std::vector<DepthView>& views) const;
  /// For shaders that include brick_disproof.glsl.
  void bind() const;
  int64_t bytes() const;

 private:
  const gl::Program& program_;
  std::vector<gl::Texture> tiles_;
};

}  // namespace limen::incremental_voxels

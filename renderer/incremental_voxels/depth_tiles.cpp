// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/incremental_voxels/depth_tiles.h"

#include <epoxy/gl.h>

#include <cassert>

#include "renderer/incremental_voxels/incremental_bindings.h"

namespace limen::incremental_voxels {

DepthTiles::DepthTiles(gl::Context& context, const std::vector<glm::ivec2>& viewSizesPx)
    : program_(context.programs().compute("renderer/incremental_voxels/depth_tiles.comp.glsl")) {
  for (const glm::ivec2 sizePx : viewSizesPx)
    tiles_.emplace_back(gl::Format::RG32F, (sizePx + kDepthTile - 1) / kDepthTile);
}

void DepthTiles::run(const std::vector<DepthView>& views) const {
  for (size_t i = 0; i < tiles_.size(); ++i) {
    assert((views[i].sizePx + kDepthTile - 1) / kDepthTile == tiles_[i].sizePx());
    views[i].depth->bindTexture(kViewDepthsUnit);
    tiles_[i].bindImage(kDepthTilesImage, gl::Access::Write);
    program_.use();
    glDispatchCompute(static_cast<GLuint>(tiles_[i].sizePx().x), static_cast<GLuint>(tiles_[i].sizePx().y),
                      1);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

void DepthTiles::bind() const {
  for (size_t i = 0; i < tiles_.size(); ++i) tiles_[i].bindTexture(kViewTilesUnit + static_cast<uint32_t>(i));
}

int64_t DepthTiles::bytes() const {
  int64_t sum = 0;
  for (const gl::Texture& tiles : tiles_) sum += tiles.bytes();
  return sum;
}

}  // namespace limen::incremental_voxels

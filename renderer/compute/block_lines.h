// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/compute/buffer_texture.h"
#include "renderer/compute/stream_reduction.h"
#include "renderer/gl/texture.h"

namespace limen::compute {

/// Joins reduced blocks by drawing each as a line of texels (Roger 2008, section 4.3.3): the way of machines
/// that cannot scatter.
class BlockLines {
 public:
  /// Throws Error if the driver has no textures of that size.
  BlockLines(gl::Context& context, uint32_t most, const ReductionSettings& settings);

  /// `gathered`: blockSize items a block, valid ones first; `sums`: invalid ones before each block, and in
  /// all. `to` has room for `capacity` items; what it holds beyond the valid ones is undefined up to there.
  void draw(const gl::Buffer& gathered, const gl::Buffer& sums, uint32_t blocks, const gl::Buffer& to,
            uint32_t capacity) const;
  int64_t bytes() const { return texture_.bytes(); }

 private:
  void copy(const gl::Buffer& to, uint32_t capacity) const;

  int lanes_;
  uint32_t rowWidth_, rows_;
  bool twice_;
  gl::Texture texture_;
  gl::Framebuffer framebuffer_;
  BufferTexture gatheredTexture_, sumsTexture_;
  NoVertices noVertices_;
  const gl::Program* program_;
};

}  // namespace limen::compute

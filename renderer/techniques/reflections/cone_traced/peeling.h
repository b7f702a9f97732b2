// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>

#include "renderer/frame/frame.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::techniques {

/// Layers of pixels' triangles by drawing all of them as points again for each layer (Roger 2008, section
/// 5.2.4): 2 n - 1 passes for n layers. Of triangles at the same distance in one pixel it keeps one.
class ConePeeling {
 public:
  /// Room for `room` pairs of a pixel and a triangle, at most kPeelItemsAcross * 16384.
  ConePeeling(frame::Frame& frame, int room);
  ~ConePeeling();
  ConePeeling(const ConePeeling&) = delete;
  ConePeeling& operator=(const ConePeeling&) = delete;

  /// Before the pairs are written: none yet. Binds what peel_items.glsl writes to.
  void begin() const;
  /// Sets up a program that includes peel_items.glsl.
  void configure(const gl::Program& program) const;
  /// Blends the nearest `layers` of what was written. Opens its pass.
  void peel(frame::Frame& frame, int layers) const;

  /// RGBA32F: light, and the share of the cone that is covered; not a number where pairs found no room.
  const gl::Texture& result() const { return result_; }
  uint32_t items() const;  ///< pairs of the last frame; waits for the GPU
  int64_t bytes() const;

 private:
  void draw(bool first, const gl::Texture* previous) const;

  int room_;
  float depthScale_;
  const gl::Program &draw_, &blend_;
  gl::Texture keys_, colours_, layer_, result_;
  std::array<gl::Texture, 2> depths_;
  std::array<gl::Framebuffer, 2> layerTargets_;
  gl::Framebuffer resultTarget_;
  gl::Buffer command_;
  uint32_t vertexArray_ = 0;
};

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "renderer/frame/frame.h"
#include "renderer/gl/shader_source.h"

namespace limen::techniques {

/// Vertices of patterns that the pixel shader evaluates, a texel each, and that are then copied into buffers
/// for the vertex shader to read (Bolz and Schröder 2003; SC-64). Passes "vertices" and "copy".
class PixelEvaluation {
 public:
  /// Room for so many vertices. `defines`: of the patches.
  PixelEvaluation(frame::Frame& frame, int64_t capacity, gl::ShaderDefines defines);

  int64_t capacity() const { return capacity_; }
  /// `draw` issues the points of all patterns; the patches' buffers are bound. `vertices`: how many.
  void run(frame::Frame& frame, int64_t vertices, const std::function<void()>& draw) const;
  /// Draws what was evaluated, with surface.frag.glsl.
  const gl::Program& drawProgram() const { return drawProgram_; }
  void bind() const;
  int64_t bytes() const;

 private:
  const gl::Program &texelProgram_, &drawProgram_;
  int64_t capacity_;
  gl::Texture positions_, normals_;
  gl::Framebuffer framebuffer_;
  gl::Buffer positionBuffer_, normalBuffer_;
};

}  // namespace limen::techniques

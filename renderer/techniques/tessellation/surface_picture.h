// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "renderer/frame/frame.h"
#include "renderer/frame/shaded.h"
#include "renderer/frame/triangle_ranges.h"

namespace limen::techniques {

/// The picture of a scene whose curved parts a technique draws itself: the other parts of its mesh and the
/// curved ones are rasterised together by the driver, then shaded in compute, as Shaded does, with the
/// normals interpolated between vertices. There are no shadows.
class SurfacePicture {
 public:
  /// `pass`: name of the technique's passes.
  SurfacePicture(frame::Frame& frame, const frame::ShadedSetting& shading, const std::string& pass);

  /// `draw` draws with any program whose fragment shader is surface.frag.glsl.
  void render(frame::Frame& frame, const std::function<void()>& draw);
  const gl::Texture& texture() const { return picture_; }

 private:
  frame::ShadedSetting shading_;
  std::string pass_;
  const gl::Program &meshProgram_, &shadeProgram_;
  frame::TriangleRanges mesh_;
  gl::Texture ids_, normals_, depth_, picture_;
  gl::Framebuffer framebuffer_;
};

}  // namespace limen::techniques

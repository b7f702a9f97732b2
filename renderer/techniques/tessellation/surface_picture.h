// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <optional>

#include "renderer/frame/compute_raster.h"
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

  /// With frame::Raster::Compute, for renderListed() as well.
  /// `textured`: the last words of vertices are texture coordinates; programs for render() have TEXTURED.
  SurfacePicture(frame::Frame& frame, const frame::ShadedSetting& shading, const std::string& pass,
                 frame::Raster raster, bool textured = false);

  /// `draw` draws with any program whose fragment shader is surface.frag.glsl.
  void render(frame::Frame& frame, const std::function<void()>& draw);
  /// The same by ComputeRaster; vertices are TessellatedVertex. Where the device gathers depth and index at
  /// once, colours are made in the pass that reads them.
  void renderListed(frame::Frame& frame, const frame::ListedTriangles& triangles);
  /// Before renderListed(): the scene's own triangles, in two steps without barriers, so that the caller's
  /// passes run beside them. The second needs one after the first, and renderListed() one after the second,
  /// for shader storage. Without them, or where the device cannot, renderListed() draws them all.
  void startMesh(frame::Frame& frame);
  void finishMesh(frame::Frame& frame);
  /// Triangles that `draw` makes; renders once more and waits for the GPU.
  uint32_t countTriangles(frame::Frame& frame, const std::function<void()>& draw);
  const gl::Texture& texture() const { return picture_; }

 private:
  struct Compute {
    const gl::Program& resolve;
    std::optional<frame::ComputeRaster> mesh;  ///< unless all parts are curved
    frame::ComputeRaster surface;
    const gl::Program* inOnePass = nullptr;  ///< in place of `resolve` and shading
  };
  void renderInOnePass(frame::Frame& frame, const frame::ListedTriangles& triangles);
  void shade(frame::Frame& frame);

  frame::ShadedSetting shading_;
  std::string pass_;
  const gl::Program &meshProgram_, &shadeProgram_;
  frame::TriangleRanges mesh_;
  gl::Texture ids_, normals_, depth_, picture_;
  gl::Framebuffer framebuffer_;
  std::optional<Compute> compute_;
  bool meshStarted_ = false, meshFinished_ = false;  // in this frame
};

}  // namespace limen::techniques

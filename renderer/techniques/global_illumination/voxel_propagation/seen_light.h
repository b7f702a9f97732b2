// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "renderer/gl/buffer.h"
#include "renderer/techniques/global_illumination/indirect_picture.h"

namespace limen::techniques {

/// The picture of light from the voxels around each pixel's point that it sees. Most pixels need no ray to
/// know which these are; the rays of all others are listed and traced together, and so are the pixels that
/// see none around them and look farther (reconstruct_sure, _rays, _seen and _search.comp.glsl). Few of the
/// invocations that run side by side need rays, so that tracing them where they are found takes several times
/// as long.
class SeenLight {
 public:
  /// `defines`: those of the gathering shaders; `widest`: how far pixels look, in voxels. Throws Error for
  /// pictures of 2^26 pixels or more, or of more than the device's buffers take.
  SeenLight(frame::Frame& frame, const gl::ShaderDefines& defines,
            const frame::SurfaceLightSettings& lighting, const char* pass, int widest,
            int64_t raysPerPx = kRaysPerPx);
  /// Rays that the list has room for: most scenes have below two; pixels whose rays do not fit trace them by
  /// themselves.
  static constexpr int64_t kRaysPerPx = 3;

  /// `configure`: sets what gathering needs; `tree`: see configureSurfaceLight().
  void render(frame::Frame& frame, const std::function<void(const gl::Program&)>& configure,
              const ray_tracing::RayTree* tree) const;
  const gl::Texture& texture() const { return picture_.texture(); }

  /// Of the last frame. Waits for the GPU.
  struct Costs {
    double raysPerPx = 0.0;       ///< to voxels around a pixel's point, of those that fit into the list
    double searchingShare = 0.0;  ///< of the pixels, those that look farther
  };
  Costs costs() const;

 private:
  void dispatch(const gl::Program& program, size_t list) const;
  void makeGroups(bool searches) const;

  double pixels_;
  uint32_t mostRays_;
  int widest_;
  bool indirect_;
  IndirectPicture picture_;
  const gl::Program &groups_, &rays_, &seen_, &search_;
  gl::Buffer askedRays_, askedPixels_, seenCorners_;
};

}  // namespace limen::techniques

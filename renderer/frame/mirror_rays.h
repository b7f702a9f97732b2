// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// The rays that leave the mirrors which pixels see, one a pixel (Roger 2008, section 3.2.2: a G-buffer of
/// secondary rays). A direction is the view's, mirrored at the shading normal; where that would lead below
/// the surface, at the triangle's own normal.
class MirrorRays : public FrameInput {
 public:
  static constexpr const char* kName = "mirror_rays";
  explicit MirrorRays(Frame& frame);
  void make(Frame& frame) override;
  /// RGBA32F: point of the mirror, relative to the scene's anchor; w = 1: a ray starts here, 0: none.
  const gl::Texture& origins() const { return origins_; }
  /// RGBA32F: unit vector; w = cosine between the view and the shading normal, 0 to 1. 0 without a ray.
  const gl::Texture& directions() const { return directions_; }

 private:
  const gl::Program& program_;
  gl::Texture origins_, directions_;
};

}  // namespace limen::frame

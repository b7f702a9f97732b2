// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"

namespace limen::techniques {

/// What upsampling and pull-push share: whose samples may stand for a point, and what to bind and set for it.
class Reconstruction {
 public:
  /// `depthTolerance`: distance from a point's tangent plane, as a share of its distance from the camera, at
  /// which a sample no longer counts for it. `normalPower`: of the cosine between normals that weighs a
  /// sample.
  explicit Reconstruction(double depthTolerance, double normalPower = 0.0)
      : depthTolerance_(depthTolerance), normalPower_(normalPower) {}

  /// Uniforms of surface_weight.glsl, and the picture's size and rays.
  void configure(const frame::Frame& frame, const gl::Program& program) const;

 private:
  double depthTolerance_, normalPower_;
};

/// Channels of a frame that tell what surface a pixel belongs to. Call of() outside of passes, and before
/// anything is bound.
struct SurfaceChannels {
  const gl::Texture *receivers, *depths, *normals;
  static SurfaceChannels of(frame::Frame& frame);
  /// On three texture units from `unit` on.
  void bind(uint32_t unit) const;
};

/// Half of a picture's extents at distance 1.
glm::vec2 rayScale(const frame::Frame& frame);

}  // namespace limen::techniques

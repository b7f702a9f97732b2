// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"

namespace limen::techniques {

/// What upsampling and pull-push share: which samples may represent a point, and what to bind and set for it.
class Reconstruction {
 public:
  /// `depthTolerance`: distance from a point's tangent plane, as a share of its distance from the camera, at
  /// which a sample no longer counts for it. `normalPower`: power of the cosine between normals that weights
  /// a sample.
  explicit Reconstruction(double depthTolerance, double normalPower = 0.0)
      : depthTolerance_(depthTolerance), normalPower_(normalPower) {}

  /// Uniforms of surface_weight.glsl, and the picture's size and rays.
  void configure(const frame::Frame& frame, const gl::Program& program) const;

 private:
  double depthTolerance_, normalPower_;
};

/// Channels of a frame that identify a pixel's surface. Call of() outside of passes, and before
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

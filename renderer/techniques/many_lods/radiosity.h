// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "renderer/frame/frame.h"
#include "renderer/gl/program.h"
#include "renderer/many_lods/view_atlas.h"
#include "renderer/techniques/many_lods/receiver_surface.h"

namespace limen::techniques {

inline constexpr const char* kRadiosityPass = "many_lods/radiosity";

/// Lights and their views, in GPU memory.
struct LightSet {
  const gl::Buffer& lights;  ///< VirtualLight each
  const gl::Buffer& views;   ///< CutView each; not read with Sight::Rays
  uint32_t count = 0;
  double leastDistance2 = 0.0;  ///< least squared distance that light is computed for
};

/// How much nearer to a light than a point its occluders are.
struct DepthBias {
  double world = 0.0;  ///< world units
  double slope = 0.0;  ///< share of the distance, times 1 + the tangent of the angle to the surface's normal
};

/// What virtual lights send to each pixel's surface and that it reflects towards the camera. RGBA32F,
/// W / (m^2 sr), background 0, alpha 1. All techniques of virtual lights end here and differ by how a point
/// sees a light. Source: Keller 1997; Holländer 2013, section 3.6.1.
class Radiosity {
 public:
  enum class Sight { Rays, Atlas, InPlaceAtlas };
  Radiosity(frame::Frame& frame, Sight sight, const ReceiverSurface& surface);
  /// `atlas`: null with Rays. `counts`: of InPlaceCuts, with InPlaceAtlas: where these were stopped, the
  /// picture is NaN.
  void shade(frame::Frame& frame, const LightSet& lights, const many_lods::ViewAtlas* atlas,
             const DepthBias& bias, const gl::Buffer* counts = nullptr) const;
  const gl::Texture& texture() const { return picture_; }

 private:
  ReceiverSurface surface_;
  uint32_t lightsOfPass_;
  const gl::Program& program_;
  gl::Texture picture_;
};

}  // namespace limen::techniques

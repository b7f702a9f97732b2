// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/frame/frame.h"
#include "renderer/gl/program.h"
#include "renderer/many_lods/view_atlas.h"
#include "renderer/techniques/many_lods/virtual_lights.h"

namespace limen::techniques {

inline constexpr const char* kRadiosityPass = "many_lods/radiosity";

/// How much nearer to a light than a point its occluders are.
struct DepthBias {
  double world = 0.0;  ///< world units
  double slope = 0.0;  ///< share of the distance, times 1 + the tangent of the angle to the surface's normal
};

/// One bounce of light: what virtual point lights send to each pixel's surface and that reflects diffusely.
/// RGBA32F, W / (m^2 sr), background 0, alpha 1. All techniques of virtual lights end here and differ by how
/// a point sees a light. Source: Keller 1997; Holländer 2013, section 3.6.1.
class Radiosity {
 public:
  enum class Sight { Rays, Atlas, InPlaceAtlas };
  Radiosity(frame::Frame& frame, Sight sight);
  /// `atlas`: null with Rays. `counts`: of InPlaceCuts, with InPlaceAtlas: where these were stopped, the
  /// picture is NaN.
  void shade(frame::Frame& frame, const VirtualLights& lights, const many_lods::ViewAtlas* atlas,
             const DepthBias& bias, const gl::Buffer* counts = nullptr) const;
  const gl::Texture& texture() const { return picture_; }

 private:
  const gl::Program& program_;
  gl::Texture picture_;
};

}  // namespace limen::techniques

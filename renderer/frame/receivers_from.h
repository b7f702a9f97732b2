// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "experiments/base/text.h"
#include "renderer/frame/frame.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// A point of the light, unit light coordinates.
struct EyeSetting {
  glm::dvec2 eye{0.5};
  std::string name() const { return "/eye_" + shortestNumber(eye.x) + "_" + shortestNumber(eye.y); }
  std::string key() const { return name(); }
};

/// The receivers as needed by a shadow map from another point of the light. RGBA32F: xyz = position in light
/// space, relative to that point; w as in Receivers, with the slope as seen from there, at most 1e6 times the
/// depth; 2e6 times the depth if that point is behind the surface.
class ReceiversFrom : public FrameInput {
 public:
  static constexpr const char* kName = "receivers_from";
  ReceiversFrom(Frame& frame, EyeSetting setting);
  void make(Frame& frame) override;
  const gl::Texture& texture() const { return texture_; }
  /// RG32F: gradient g of each receiver's own plane, 1 / z = (1 + g . (t - t_p)) / p_z with tangents
  /// t = (x/z, y/z); see receiver_plane.glsl; from points behind the surface, too. 0 where there is no
  /// receiver.
  const gl::Texture& planes() const { return planes_; }

 private:
  EyeSetting setting_;
  const gl::Program& program_;
  gl::Texture texture_, planes_;
};

}  // namespace limen::frame

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "renderer/frame/shadow_map.h"

namespace limen::techniques {

/// Depth images of a scene from the centre of its light, separately for casters and receivers
/// (Part::receiverOnly), by the driver's rasteriser: near / z. Source: Schwarz 2009, section 3.2.1 (after
/// Atty et al. 2006).
class LightLayers {
 public:
  enum class Faces {
    All,      ///< of casters
    Towards,  ///< front faces as seen from the light's centre
    Away      ///< back faces
  };
  /// `withSecond`: also the farthest surface of casters.
  LightLayers(frame::Frame& frame, int resolution, int receiverResolution, bool withSecond);

  void draw(frame::Frame& frame, Faces nearest, Faces farthest) const;

  /// Nearest surface of casters, 0: none.
  const gl::Texture& nearest() const { return *nearest_; }
  /// Farthest surface of casters, 1: none.
  const gl::Texture& farthest() const { return *farthest_; }
  /// Nearest surface of receivers, 0: none.
  const gl::Texture& receivers() const { return *receivers_; }
  const frame::LightFrustum& casterFrustum() const { return casterFrustum_; }
  /// All receivers that a caster can shadow.
  const frame::LightFrustum& receiverFrustum() const { return receiverFrustum_; }
  /// Light-space z that no receiver exceeds.
  double farthestReceiver() const { return farthestReceiver_; }
  int64_t bytes() const;

 private:
  void fitReceivers(const scene::Scene& scene);
  void pass(frame::Frame& frame, const gl::Framebuffer& target, const frame::LightFrustum& frustum,
            const frame::TriangleRanges& ranges, bool nearest, Faces faces) const;

  const gl::Program& program_;
  frame::LightFrustum casterFrustum_, receiverFrustum_;
  double farthestReceiver_ = 0.0;
  frame::TriangleRanges casterRanges_, receiverRanges_;
  std::optional<gl::Texture> nearest_, farthest_, receivers_;
  std::optional<gl::Framebuffer> nearestTarget_, farthestTarget_, receiverTarget_;
};

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/frame/shadow_map.h"

namespace limen::frame {

/// Which triangle each texel of the shadow map sees. The map is rasterised a second time for it: techniques
/// that need no ids should not pay for them.
class ShadowTriangles : public FrameInput {
 public:
  static constexpr const char* kName = "shadow_triangles";
  ShadowTriangles(Frame& frame, ShadowMapSettings settings);
  void make(Frame& frame) override;
  const gl::Texture& ids() const { return raster_.ids(); }  ///< R32UI, 0xffffffff: none
  const LightFrustum& frustum() const { return frustum_; }

 private:
  ShadowRaster raster_;
  LightFrustum frustum_;
  std::string pass_;
};

/// Depth bias b and height h of each texel of each level of the minimum pyramid: a texel at depth z
/// represents a piece of surface within [z - h, z + b]. Source: Schwarz 2009, section 4.5.4.
///
/// At level 0 h is b, the change of depth from the texel's centre to its farthest corner on the plane of the
/// triangle that it sees. A texel of a coarser level is combined from the four below, nearest first (the
/// thesis does not say in which order): where depth ranges overlap, the farther part is taken to be the same
/// surface and the range is widened to include it; otherwise it is left to be shadowed by the nearer.
class BiasLevels {
 public:
  /// `resolution` is a power of two.
  BiasLevels(gl::Context& context, int resolution);
  /// Makes the coarser levels from level 0 of biases() and the levels of `minimum`. Ranges separated by no
  /// more than `tolerance` of their depth, as rounding can cause, count as overlapping.
  void aggregate(const gl::Texture& minimum, float tolerance) const;
  const gl::Texture& biases() const { return biases_; }  ///< RG32F: b, h, in units of z
  int64_t bytes() const { return biases_.bytes(); }

 private:
  int resolution_;
  const gl::Program& program_;
  gl::Texture biases_;
};

struct BiasSettings {
  ShadowMapSettings map;
  float maxSlope =
      10.0F;  ///< of depth, relative to it and to the light-space tangent: slopes are clamped here
  float tolerance = 1e-4F;  ///< of aggregate()
  std::string key() const;
};

/// Biases of the shadow map, in their own passes.
class BiasMap : public FrameInput {
 public:
  static constexpr const char* kName = "bias_map";
  BiasMap(Frame& frame, BiasSettings settings);
  void make(Frame& frame) override;
  const BiasLevels& levels() const { return levels_; }

 private:
  BiasSettings settings_;
  const gl::Program& slopes_;
  BiasLevels levels_;
  std::string pass_;
};

}  // namespace limen::frame

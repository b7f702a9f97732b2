// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/frame/frame.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// The finest texel whose depth a coarse one holds.
enum class SampledTexel {
  Lattice,  ///< fixed by the coarse texel's place, at changing places within it (sampled_texel.glsl)
  Centre,   ///< at its centre
  Median    ///< of four, one in each quarter: that with the second nearest depth
};
struct SampledTexelSetting {
  SampledTexel texel = SampledTexel::Lattice;
  std::string key() const { return std::to_string(static_cast<int>(texel)); }
  /// For sampled_texel.glsl.
  gl::ShaderDefines defines() const {
    if (texel == SampledTexel::Lattice) return {};
    return {{texel == SampledTexel::Centre ? "DEPTHS_CENTRE" : "DEPTHS_MEDIAN", "1"}};
  }
};

/// Coarse levels of a linear shadow map whose texels of 2^i x 2^i finest ones hold the depth of one of these.
/// In contrast to minima, which grow
/// thin occluders to the size of a coarse texel, samples cover the right share on average. Own form; no
/// source.
///
/// One R32F texture holds all levels above 0 of a map of R x R texels: level i from (0, R - 2R / 2^i) on.
class SampledPyramid : public FrameInput {
 public:
  static constexpr const char* kName = "sampled_pyramid";
  SampledPyramid(Frame& frame, ShadowMapSettings settings, SampledTexelSetting texel = {});
  void make(Frame& frame) override;
  const gl::Texture& atlas() const { return atlas_.own(); }
  const gl::Texture& shared() const { return atlas_.shared(); }  ///< as for MapTexture

 private:
  ShadowMapSettings settings_;
  const gl::Program& program_;
  MapTexture atlas_;
  std::string pass_;
};

}  // namespace limen::frame

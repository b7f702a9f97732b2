// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "renderer/frame/frame.h"
#include "renderer/frame/shadow_map.h"
#include "renderer/gl/program.h"
#include "renderer/gl/texture.h"

namespace limen::frame {

/// Coarse levels of a linear shadow map whose texels of 2^i x 2^i finest ones hold the depth of one of these:
/// which one is fixed by the texel's place (sampled_texel.glsl). In contrast to minima, which grow
/// thin occluders to the size of a coarse texel, samples cover the right share on average. Own form; no
/// source.
///
/// One R32F texture holds all levels above 0 of a map of R x R texels: level i from (0, R - 2R / 2^i) on.
class SampledPyramid : public FrameInput {
 public:
  static constexpr const char* kName = "sampled_pyramid";
  SampledPyramid(Frame& frame, ShadowMapSettings settings);
  void make(Frame& frame) override;
  const gl::Texture& atlas() const { return atlas_; }

 private:
  ShadowMapSettings settings_;
  const gl::Program& program_;
  gl::Texture atlas_;
  std::string pass_;
};

}  // namespace limen::frame

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/sampled_pyramid.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "renderer/frame/frame_bindings.h"

namespace limen::frame {

SampledPyramid::SampledPyramid(Frame& frame, ShadowMapSettings settings, SampledTexelSetting texel)
    : settings_(settings),
      program_(
          frame.context().programs().compute("renderer/frame/sampled_pyramid.comp.glsl", texel.defines())),
      atlas_(gl::Format::R32F, {std::max(settings.resolution / 2, 1), settings.resolution}, 1, 0, settings,
             settings.first() ? &frame.get<SampledPyramid>(*settings.first(), texel).atlas_ : nullptr),
      pass_("frame/sampled_pyramid" + settings.name()) {
  frame.passes().setBytesHeld(pass_, atlas().bytes());
}

void SampledPyramid::make(Frame& frame) {
  const gl::Texture& map = frame.get<MinMaxPyramid>(settings_).minimum();
  const auto scope = frame.passes().open(pass_);
  program_.set("resolution", settings_.resolution);
  map.bindTexture(kSampledPyramidMapUnit);
  atlas().bindImage(kSampledPyramidImage, gl::Access::Write);
  program_.dispatch(atlas().sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace limen::frame

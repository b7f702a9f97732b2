// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/visibility_technique.h"

#include "renderer/techniques/soft_shadows/shadow_bindings.h"

namespace limen::techniques {

VisibilityTechnique::VisibilityTechnique(const MapSettings& map, const BiasSettings& bias, std::string shader,
                                         std::string pass, gl::ShaderDefines defines)
    : map_{map.resolution, map.raster},
      bias_(bias),
      pass_(std::move(shader), std::move(pass), std::move(defines)) {
  pass_.define(bias_.defines());
}

void VisibilityTechnique::prepare(frame::Frame& frame) {
  pass_.prepare(frame);
  pass_.compile(frame);
  frame.passes().setBytesHeld(pass_.name(), pass_.visibility().bytes());
}

const frame::LightFrustum& VisibilityTechnique::bindMap(frame::Frame& frame) {
  const auto& map = frame.get<frame::ShadowMap>(map_);
  map.texture().bindTexture(kShadowMapUnit);
  return map.frustum();
}

const frame::LightFrustum& VisibilityTechnique::bindPyramid(frame::Frame& frame) {
  const BoundPyramid pyramid = techniques::bindPyramid(frame, map_);
  pyramidLevels_ = pyramid.levels;
  return pyramid.frustum;
}

const frame::LightFrustum& VisibilityTechnique::bindInputs(frame::Frame& frame,
                                                           const frame::ShadowMapSettings&) {
  // Made before anything is bound: making binds textures too.
  bias_.make(frame, map_);
  const frame::LightFrustum& frustum = bindMap(frame);
  bias_.bind();
  return frustum;
}

void VisibilityTechnique::setUniforms(const gl::Program& program) const {
  bias_.configure(program);
  configure(program);
}

void VisibilityTechnique::run(frame::Frame& frame, const CountImages* counts) {
  VisibilityPass::makeInputs(frame, *this, map_);
  const auto scope = frame.passes().open(pass_.name());
  pass_.run(frame, *this, map_, counts);
}

void VisibilityTechnique::render(frame::Frame& frame) { run(frame, nullptr); }

std::vector<Counter> VisibilityTechnique::count(frame::Frame& frame) {
  const CountImages counts{gl::Texture(gl::Format::RGBA32UI, frame.sizePx()),
                           gl::Texture(gl::Format::RGBA32UI, frame.sizePx())};
  counted_ = {frame.sizePx(), {}, {}};
  frame.begin();
  run(frame, &counts);
  frame.end();
  counted_.add(counts);
  return visibilityCounters(counted_);
}

}  // namespace limen::techniques

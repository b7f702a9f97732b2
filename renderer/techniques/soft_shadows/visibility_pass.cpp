// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/soft_shadows/visibility_pass.h"

#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/receivers_from.h"
#include "renderer/techniques/soft_shadows/shadow_bindings.h"

namespace limen::techniques {
namespace {

struct ReceiverTextures {
  const gl::Texture &points, &planes;
};

ReceiverTextures receiversOf(frame::Frame& frame, glm::dvec2 eye) {
  if (eye == glm::dvec2(0.5)) {
    const auto& centre = frame.get<frame::Receivers>();
    return {centre.texture(), centre.planes()};
  }
  const auto& other = frame.get<frame::ReceiversFrom>(frame::EyeSetting{eye});
  return {other.texture(), other.planes()};
}

}  // namespace

VisibilityPass::VisibilityPass(std::string shader, std::string name, gl::ShaderDefines defines)
    : shader_(std::move(shader)), name_(std::move(name)), defines_(std::move(defines)) {}

void VisibilityPass::define(const gl::ShaderDefines& more) {
  for (const auto& [name, value] : more) defines_[name] = value;
}

void VisibilityPass::prepare(frame::Frame& frame) { visibility_.emplace(gl::Format::R32F, frame.sizePx()); }

const gl::Program& VisibilityPass::program(frame::Frame& frame, bool counting,
                                           const gl::ShaderDefines& more) const {
  gl::ShaderDefines defines = defines_;
  defines.insert(more.begin(), more.end());
  if (counting) defines["COUNT"] = "1";
  return frame.context().programs().compute(shader_, defines);
}

void VisibilityPass::makeInputs(frame::Frame& frame, PassInputs& inputs,
                                const frame::ShadowMapSettings& map) {
  inputs.bindInputs(frame, map);
  receiversOf(frame, map.eye);
}

void VisibilityPass::bind(frame::Frame& frame, const gl::Program& program, PassInputs& inputs,
                          const frame::ShadowMapSettings& map, const CountImages* counts) const {
  const frame::LightFrustum& frustum = inputs.bindInputs(frame, map);
  setMapUniforms(program, frame, frustum, map);
  inputs.setUniforms(program);
  const ReceiverTextures receivers = receiversOf(frame, map.eye);
  receivers.points.bindTexture(kReceiversUnit);
  receivers.planes.bindTexture(kReceiverPlanesUnit);
  visibility_->bindImage(kVisibilityImage, gl::Access::Write);
  if (!counts) return;
  counts->work.bindImage(kCountsImage, gl::Access::ReadWrite);
  counts->search.bindImage(kSearchImage, gl::Access::Write);
}

void VisibilityPass::run(frame::Frame& frame, PassInputs& inputs, const frame::ShadowMapSettings& map,
                         const CountImages* counts) const {
  const gl::Program& chosen = counts ? program(frame, true) : *plain_;
  bind(frame, chosen, inputs, map, counts);
  chosen.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

void setMapUniforms(const gl::Program& program, const frame::Frame& frame, const frame::LightFrustum& frustum,
                    const frame::ShadowMapSettings& map) {
  program.set("sizePx", frame.sizePx());
  program.set("tangentLow", glm::vec2(frustum.low));
  program.set("tangentSize", glm::vec2(frustum.high - frustum.low));
  program.set("near", static_cast<float>(frustum.near));
  program.set("lightSize", glm::vec2(frame.scene().lights[0].size));
  program.set("eyeOnLight", glm::vec2(map.eye));
  program.set("resolution", map.resolution);
}

BoundPyramid bindPyramid(frame::Frame& frame, const frame::ShadowMapSettings& map) {
  const auto& pyramid = frame.get<frame::MinMaxPyramid>(map);
  pyramid.sharedMinimum().bindTexture(kMinimumMapUnit);
  pyramid.sharedMaximum().bindTexture(kMaximumMapUnit);
  return {pyramid.frustum(), pyramid.levels()};
}

int maxLoopIterations(frame::Frame& frame) { return frame.context().device().software ? 60000 : 0x7fffffff; }

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/many_lods/radiosity.h"

#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/ray_tracing/ray_scene.h"
#include "renderer/techniques/many_lods/many_lods_pass_bindings.h"

namespace limen::techniques {

namespace {

gl::ShaderDefines sightDefines(Radiosity::Sight sight) {
  if (sight == Radiosity::Sight::Rays) return {{"TRACED", "1"}};
  if (sight == Radiosity::Sight::InPlaceAtlas) return {{"IN_PLACE", "1"}};
  return {};
}

}  // namespace

Radiosity::Radiosity(frame::Frame& frame, Sight sight)
    : program_(frame.context().programs().compute("renderer/techniques/many_lods/radiosity.comp.glsl",
                                                  sightDefines(sight))),
      picture_(gl::Format::RGBA32F, frame.sizePx()) {
  frame.passes().setBytesHeld(kRadiosityPass, picture_.bytes());
}

void Radiosity::shade(frame::Frame& frame, const VirtualLights& lights, const many_lods::ViewAtlas* atlas,
                      const DepthBias& bias, const gl::Buffer* counts) const {
  const auto channel = [&](frame::Channel of) -> const gl::Texture& {
    return frame.get<frame::GBufferChannel>(frame::ChannelSetting{of}).texture();
  };
  const gl::Texture& positions = channel(frame::Channel::Position);
  const gl::Texture& normals = channel(frame::Channel::Normal);
  const gl::Texture& albedos = channel(frame::Channel::Albedo);
  const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
  const auto scope = frame.passes().open(kRadiosityPass);
  positions.bindTexture(kRadiosityPositionsUnit);
  normals.bindTexture(kRadiosityNormalsUnit);
  albedos.bindTexture(kRadiosityAlbedosUnit);
  ids.bindTexture(kRadiosityIdsUnit);
  lights.lights().bindStorage(kRadiosityLightsBuffer);
  if (atlas) {
    lights.views().bindStorage(kRadiosityViewsBuffer);
    atlas->depths().bindStorage(kRadiosityDepthsBuffer);
    program_.set("side", atlas->tilePx().x);
    program_.set("depthBias", static_cast<float>(bias.world));
    program_.set("slopeBias", static_cast<float>(bias.slope));
  } else {
    frame.gpuScene().rays(frame.context()).bind(program_);
  }
  if (counts) counts->bindStorage(kRadiosityCountsBuffer);
  picture_.bindImage(kRadiosityImage, gl::Access::Write);
  program_.set("sizePx", frame.sizePx());
  program_.set("lightCount", lights.count());
  program_.set("leastDistance2", static_cast<float>(lights.leastDistance2()));
  program_.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::techniques

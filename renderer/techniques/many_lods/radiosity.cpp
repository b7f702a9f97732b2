// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/many_lods/radiosity.h"

#include <epoxy/gl.h>

#include <algorithm>

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

// A software renderer ends loops after 65,535 rounds without a word: rays through large scenes take some
// hundred each.
uint32_t lightsOfPass(Radiosity::Sight sight, bool software) {
  if (sight == Radiosity::Sight::Rays) return software ? 128 : 1024;
  return 16384;
}

}  // namespace

Radiosity::Radiosity(frame::Frame& frame, Sight sight, const ReceiverSurface& surface)
    : surface_(surface),
      lightsOfPass_(lightsOfPass(sight, frame.context().device().software)),
      program_(frame.context().programs().compute("renderer/techniques/many_lods/radiosity.comp.glsl",
                                                  sightDefines(sight))),
      picture_(gl::Format::RGBA32F, frame.sizePx()) {
  frame.passes().setBytesHeld(kRadiosityPass, picture_.bytes());
}

void Radiosity::shade(frame::Frame& frame, const LightSet& lights, const many_lods::ViewAtlas* atlas,
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
  lights.lights.bindStorage(kRadiosityLightsBuffer);
  if (atlas) {
    lights.views.bindStorage(kRadiosityViewsBuffer);
    atlas->depths().bindStorage(kRadiosityDepthsBuffer);
    program_.set("side", atlas->tilePx().x);
    program_.set("depthBias", static_cast<float>(bias.world));
    program_.set("slopeBias", static_cast<float>(bias.slope));
  } else {
    frame.gpuScene().rays(frame.context()).bind(program_);
  }
  if (counts) counts->bindStorage(kRadiosityCountsBuffer);
  picture_.bindImage(kRadiosityImage, gl::Access::ReadWrite);
  program_.set("sizePx", frame.sizePx());
  program_.set("leastDistance2", static_cast<float>(lights.leastDistance2));
  program_.set("distantNear", static_cast<float>(1e-4 * frame.gpuScene().diagonal()));
  configureReceivers(program_, frame, surface_);
  for (uint32_t first = 0; first < lights.count; first += lightsOfPass_) {
    program_.set("firstLight", first);
    program_.set("lightCount", std::min(first + lightsOfPass_, lights.count));
    program_.dispatch(frame.sizePx());
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  }
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::techniques

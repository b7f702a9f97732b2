// SPDX-License-Identifier: BSD-3-Clause
#include "experiments/viewer/presenter.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cmath>

#include "experiments/product.h"
#include "experiments/viewer/present_bindings.h"
#include "renderer/frame/g_buffer.h"

namespace limen::viewer {
namespace {

using frame::Channel;
using frame::ChannelSetting;
using frame::GBufferChannel;

uint8_t byteOf(float value) {
  return static_cast<uint8_t>(std::lround(255.0F * std::clamp(value, 0.0F, 1.0F)));
}

}  // namespace

ScreenPicture screenPicture(const Image& displayCoded) {
  ScreenPicture out{{displayCoded.width, displayCoded.height}, {}};
  out.rgba.resize(displayCoded.pixels() * 4, 255);
  const auto channels = static_cast<size_t>(displayCoded.channels);
  for (size_t i = 0; i < displayCoded.pixels(); ++i)
    for (size_t c = 0; c < 3; ++c)
      out.rgba[4 * i + c] = byteOf(displayCoded.data[channels * i + (channels < 3 ? 0 : c)]);
  return out;
}

Presenter::Presenter(gl::Context& context, const frame::SceneOnGpu& onGpu, glm::ivec2 sizePx)
    : context_(context),
      onGpu_(onGpu),
      sizePx_(sizePx),
      frame_(context, onGpu, sizePx),
      picture_(gl::Format::RGBA8, sizePx) {}

frame::Frame& Presenter::view() {
  if (!fresh_) {
    frame_.setTime(0.0);
    frame_.begin();
    frame_.end();
    fresh_ = true;
  }
  return frame_;
}

ScreenPicture Presenter::picture(techniques::ProductKind kind, const gl::Texture& product) {
  using techniques::ProductKind;
  if (kind == ProductKind::Visibility || kind == ProductKind::LightColour || kind == ProductKind::Colour)
    return shaded(kind != ProductKind::Colour, product);
  return screenPicture(experiments::productPicture(kind, product.read(), {}));
}

ScreenPicture Presenter::shaded(bool isShare, const gl::Texture& product) {
  const gl::Program& program = context_.programs().compute("experiments/viewer/present.comp.glsl");
  if (isShare) {
    // Before any is bound, since creating them binds textures too.
    frame::Frame& frame = view();
    const gl::Texture* inputs[] = {&frame.get<frame::Receivers>().texture(),
                                   &frame.get<GBufferChannel>(ChannelSetting{Channel::Normal}).texture(),
                                   &frame.get<GBufferChannel>(ChannelSetting{Channel::Position}).texture(),
                                   &frame.get<GBufferChannel>(ChannelSetting{Channel::Albedo}).texture()};
    const uint32_t units[] = {kPresentReceiversUnit, kPresentNormalsUnit, kPresentPositionsUnit,
                              kPresentAlbedosUnit};
    for (size_t i = 0; i < 4; ++i) inputs[i]->bindTexture(units[i]);
    const scene::Scene& scene = onGpu_.scene;
    program.set("light", scene.lights.empty() ? glm::vec3(0.0F)
                                              : glm::vec3(scene.lights[0].centre - onGpu_.gpu.anchor()));
  }
  product.bindTexture(kPresentProductUnit);
  picture_.bindImage(kPresentImage, gl::Access::Write);
  program.set("sizePx", sizePx_);
  program.set("isShare", isShare ? 1 : 0);
  program.set("isGrey", gl::channelCount(product.format()) == 1 ? 1 : 0);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  program.dispatch(sizePx_);
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  ScreenPicture out{sizePx_, {}};
  out.rgba.resize(static_cast<size_t>(sizePx_.x) * static_cast<size_t>(sizePx_.y) * 4);
  glGetTextureImage(picture_.id(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(out.rgba.size()),
                    out.rgba.data());
  return out;
}

}  // namespace limen::viewer

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/frame/receivers_from.h"

#include <epoxy/gl.h>

#include "renderer/frame/frame_bindings.h"
#include "renderer/frame/g_buffer.h"

namespace limen::frame {

ReceiversFrom::ReceiversFrom(Frame& frame, EyeSetting setting)
    : setting_(setting),
      program_(frame.context().programs().compute("renderer/frame/receivers_from.comp.glsl")),
      texture_(gl::Format::RGBA32F, frame.sizePx()) {
  frame.passes().setBytesHeld("frame/receivers" + setting_.name(), texture_.bytes());
}

void ReceiversFrom::make(Frame& frame) {
  const gl::Texture& receivers = frame.get<Receivers>().texture();
  const gl::Texture& normals = frame.get<GBufferChannel>(ChannelSetting{Channel::Normal}).texture();
  const auto scope = frame.passes().open("frame/receivers" + setting_.name());
  const scene::AreaLight& light = frame.scene().lights.at(0);
  program_.set("sizePx", frame.sizePx());
  program_.set("anchorToLight", glm::mat3(light.toLightSpace()));
  program_.set("eye", glm::vec2((setting_.eye - 0.5) * light.size));
  receivers.bindTexture(kReceiversFromReceiversUnit);
  normals.bindTexture(kReceiversFromNormalsUnit);
  texture_.bindImage(kReceiversFromImage, gl::Access::Write);
  program_.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace limen::frame

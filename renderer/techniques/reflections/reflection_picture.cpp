// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/reflections/reflection_picture.h"

#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/frame/mirror_rays.h"
#include "renderer/techniques/reflections/reflection_bindings.h"

namespace limen::techniques {

void ReflectionPicture::prepare(frame::Frame& frame) {
  program_ = &frame.context().programs().compute(
      "renderer/techniques/reflections/compose.comp.glsl",
      refraction_ ? gl::ShaderDefines{{"REFRACT", "1"}} : gl::ShaderDefines{});
  picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
  frame.passes().setBytesHeld("reflections/compose", picture_->bytes());
}

void ReflectionPicture::compose(frame::Frame& frame, const gl::Texture& reflected) {
  const gl::Texture& local = frame.get<frame::Shaded>(shading_).texture();
  const frame::MirrorRays& rays = frame::firstRays(frame, refraction_);
  const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
  const auto scope = frame.passes().open("reflections/compose");
  program_->set("sizePx", frame.sizePx());
  program_->set("background", glm::vec3(static_cast<float>(shading_.background)));
  frame.bindSurfaces();
  rays.directions().bindTexture(kReflectionDirectionsUnit);
  rays.origins().bindTexture(kReflectionOriginsUnit);
  ids.bindTexture(kReflectionIdsUnit);
  local.bindTexture(kComposeLocalUnit);
  reflected.bindTexture(kComposeReflectedUnit);
  picture_->bindImage(kComposeImage, gl::Access::Write);
  program_->dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::techniques

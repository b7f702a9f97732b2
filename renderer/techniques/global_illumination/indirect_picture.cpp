// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/global_illumination/indirect_picture.h"

#include <epoxy/gl.h>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/global_illumination/illumination_bindings.h"
#include "renderer/techniques/global_illumination/surface_light.h"

namespace limen::techniques {
namespace {

gl::ShaderDefines litDefines(const frame::SurfaceLightSettings& lighting, const frame::Frame& frame,
                             const gl::ShaderDefines& more) {
  gl::ShaderDefines defines = surfaceLightDefines(lighting, frame);
  for (const auto& [name, value] : more) defines[name] = value;
  return defines;
}

}  // namespace

IndirectPicture::IndirectPicture(frame::Frame& frame, const std::string& shader,
                                 const gl::ShaderDefines& defines,
                                 const frame::SurfaceLightSettings& lighting, const char* pass)
    : program_(frame.context().programs().compute(shader, litDefines(lighting, frame, defines))),
      lighting_(lighting),
      pass_(pass),
      picture_(gl::Format::RGBA32F, frame.sizePx()) {
  frame.passes().setBytesHeld(pass, picture_.bytes());
}

void IndirectPicture::render(frame::Frame& frame, const std::function<void(const gl::Program&)>& configure,
                             const ray_tracing::RayTree* tree) const {
  const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
  const auto scope = frame.passes().open(pass_);
  configureSurfaceLight(program_, frame, lighting_, tree);
  configure(program_);
  program_.set("withDirect", lighting_.light != frame::LightPart::Indirect ? 1 : 0);
  program_.set("withIndirect", lighting_.light != frame::LightPart::Direct ? 1 : 0);
  ids.bindTexture(kIndirectIdsUnit);
  picture_.bindImage(kIndirectPictureImage, gl::Access::Write);
  program_.dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::techniques

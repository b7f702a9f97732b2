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
    : lighting_(lighting),
      program_(program(frame, shader, defines)),
      pass_(pass),
      picture_(gl::Format::RGBA32F, frame.sizePx()) {
  frame.passes().setBytesHeld(pass, picture_.bytes());
}

const gl::Program& IndirectPicture::program(frame::Frame& frame, const std::string& shader,
                                            const gl::ShaderDefines& defines) const {
  return frame.context().programs().compute(shader, litDefines(lighting_, frame, defines));
}

void IndirectPicture::configure(const gl::Program& program, frame::Frame& frame,
                                const ray_tracing::RayTree* tree) const {
  configureSurfaceLight(program, frame, lighting_, tree);
  program.set("withDirect", lighting_.light != frame::LightPart::Indirect ? 1 : 0);
  program.set("withIndirect", lighting_.light != frame::LightPart::Direct ? 1 : 0);
}

void IndirectPicture::render(frame::Frame& frame, const std::function<void(const gl::Program&)>& configure,
                             const ray_tracing::RayTree* tree, const std::function<void()>& after) const {
  const gl::Texture& ids = frame.get<frame::TriangleIds>().texture();
  {
    const auto scope = frame.passes().open(pass_);
    this->configure(program_, frame, tree);
    configure(program_);
    ids.bindTexture(kIndirectIdsUnit);
    picture_.bindImage(kIndirectPictureImage, gl::Access::ReadWrite);
    program_.dispatch(frame.sizePx());
    glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  }
  if (after) after();
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
}

}  // namespace limen::techniques

// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/antialiasing/one_sample_picture.h"

#include <epoxy/gl.h>

#include "renderer/techniques/antialiasing/antialiasing_bindings.h"

namespace limen::techniques {

void OneSamplePicture::prepare(frame::Frame& frame) {
  view_.emplace(frame, 1, settings_);
  gl::ShaderDefines defines = view_->defines();
  defineEnum(defines, "FORM", SampleForm::First);
  program_ = &frame.context().programs().compute("renderer/techniques/antialiasing/shade_samples.comp.glsl",
                                                 defines);
  picture_.emplace(gl::Format::RGBA32F, frame.sizePx());
  frame.passes().setBytesHeld("antialiasing/first", picture_->bytes());
}

void OneSamplePicture::render(frame::Frame& frame) {
  view_->make();
  const auto scope = frame.passes().open("antialiasing/first");
  view_->configure(*program_);
  picture_->bindImage(kSampleOutImage, gl::Access::Write);
  program_->dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::techniques

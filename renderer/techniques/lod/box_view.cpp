// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/lod/box_view.h"

#include <epoxy/gl.h>

#include "experiments/base/error.h"
#include "renderer/techniques/lod/lod_bindings.h"

namespace limen::techniques {

BoxView::BoxView(frame::Frame& parent, const std::string& name, frame::ShadedSetting shaded, int samples)
    : parent_(parent), shaded_(std::move(shaded)), samples_(samples), pass_(name + "/resolve") {
  const glm::ivec2 sizePx = parent.sizePx() * samples;
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (std::max(sizePx.x, sizePx.y) > largest)
    throw Error(std::to_string(samples) + " samples along each axis need an image of " +
                    std::to_string(sizePx.x) + " x " + std::to_string(sizePx.y),
                {},
                "this driver has at most " + std::to_string(largest) + ": lower 'samples' or the image size");
  frame_ = std::make_unique<frame::Frame>(parent, name, sizePx);
  if (samples == 1) return;
  resolve_ = &parent.context().programs().compute("renderer/techniques/lod/box_resolve.comp.glsl");
  resolved_.emplace(gl::Format::RGBA32F, parent.sizePx());
  parent.passes().setBytesHeld(pass_, resolved_->bytes());
}

void BoxView::renderAt(double timeS) {
  frame_->setTime(timeS);
  frame_->begin();
  texture_ = &frame_->get<frame::Shaded>(shaded_).texture();
  frame_->end();
  if (!resolve_) return;
  const auto scope = parent_.passes().open(pass_);
  resolve_->set("samples", samples_);
  resolve_->set("sizePx", parent_.sizePx());
  texture_->bindTexture(kBoxResolveSampledUnit);
  resolved_->bindImage(kBoxResolveImage, gl::Access::Write);
  resolve_->dispatch(parent_.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  texture_ = &*resolved_;
}

}  // namespace limen::techniques

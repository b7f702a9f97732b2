// SPDX-License-Identifier: BSD-3-Clause
#include "renderer/techniques/visibility_fields/tile_filter.h"

#include <epoxy/gl.h>

#include <cmath>

#include "renderer/frame/g_buffer.h"
#include "renderer/techniques/visibility_fields/field_pass_bindings.h"

namespace limen::techniques {

const BilateralFilter* TileFilter::bilateral() const {
  const auto* interleaved = std::get_if<InterleavedPattern>(&rays_.pattern);
  return interleaved ? std::get_if<BilateralFilter>(&interleaved->filter) : nullptr;
}

void TileFilter::prepare(frame::Frame& frame) {
  if (!bilateral()) return;
  gl::ShaderDefines defines{{"OUT_FORMAT", format_ == gl::Format::R32F ? "r32f" : "rgba32f"}};
  if (format_ == gl::Format::R32F) defines["RECEIVERS_ONLY"] = "1";
  program_ = &frame.context().programs().compute(
      "renderer/techniques/visibility_fields/tile_filter.comp.glsl", defines);
  filtered_.emplace(format_, frame.sizePx());
  frame.passes().setBytesHeld(pass_, filtered_->bytes());
}

void TileFilter::run(frame::Frame& frame, const gl::Texture& raw) {
  const BilateralFilter* filter = bilateral();
  if (!filter) return;
  ReceiverRays::makeInputs(frame);
  if (format_ == gl::Format::R32F) frame.get<frame::Receivers>();
  const auto scope = frame.passes().open(pass_);
  rays_.configure(*program_, frame);
  if (format_ == gl::Format::R32F) frame.get<frame::Receivers>().texture().bindTexture(kFieldReceiversUnit);
  raw.bindTexture(kFieldUnfilteredUnit);
  program_->set("slopeLimit", static_cast<float>(std::sin(glm::radians(filter->angleDeg))));
  program_->set("cosineLimit", static_cast<float>(std::cos(glm::radians(filter->angleDeg))));
  filtered_->bindImage(kFieldOutImage, gl::Access::Write);
  program_->dispatch(frame.sizePx());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
}

}  // namespace limen::techniques
